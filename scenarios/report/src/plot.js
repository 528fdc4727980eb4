// Curves: read-out under the pointer, zoom by drag, double-click to reset, one cursor of time in all of them.
(() => {
  const svgNS = 'http://www.w3.org/2000/svg';
  const make = (name, attributes, parent) => {
    const element = document.createElementNS(svgNS, name);
    for (const key in attributes) element.setAttribute(key, attributes[key]);
    return parent.appendChild(element);
  };
  const niceStep = (span, count) => {
    const least = span / count, decade = Math.pow(10, Math.floor(Math.log10(least)));
    return ([1, 2, 2.5, 5].find((m) => m * decade >= least * (1 - 1e-9)) || 10) * decade;
  };
  const raised = (power) => [...power].map((c) => c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c]).join('');
  const minus = (text) => text.replace(/\.?0*e\+?(-?\d+)/, (all, power) => `·10${raised(power)}`).replace(/^1·/, '').replace(/-/g, '\u2212');
  const tickLabel = (value, step) => {
    if (Math.abs(value) <= 1e-6 * step) return '0';
    let places = -Math.floor(Math.log10(step) + 1e-9);
    const leading = step * Math.pow(10, places);
    if (Math.abs(leading - Math.round(leading)) > 1e-6) places += 1;
    return minus(Math.abs(places) > 5 ? value.toExponential(2) : value.toFixed(Math.max(places, 0)));
  };
  const shown = (value) => {
    const size = Math.abs(value);
    if (size === 0) return '0';
    if (size >= 1e5 || size <= 1e-4) return minus(value.toExponential(2));
    return minus(size >= 1000 ? value.toFixed(0) : value.toPrecision(3));
  };
  const plots = [];
  const readout = document.createElement('div');
  readout.className = 'readout';
  readout.hidden = true;
  document.body.appendChild(readout);

  const secondsPer = (label) => label.startsWith('time [ms]') ? 1e-3 : label.startsWith('time [s]') ? 1 : 0;

  function start(svg) {
    const [x0, x1, y0, y1] = svg.dataset.range.split(' ').map(Number);
    const [left, top, width, height] = svg.dataset.area.split(' ').map(Number);
    const log = svg.dataset.scale === 'log';
    const into = log ? Math.log10 : (v) => v, back = log ? (v) => Math.pow(10, v) : (v) => v;
    const full = { x: [into(x0), into(x1)], y: [into(y0), into(y1)] };
    let view = full;
    const px = (x) => left + (x - view.x[0]) / (view.x[1] - view.x[0]) * width;
    const py = (y) => top + height - (y - view.y[0]) / (view.y[1] - view.y[0]) * height;
    const xAt = (p) => view.x[0] + (p - left) / width * (view.x[1] - view.x[0]);
    const yAt = (p) => view.y[0] + (top + height - p) / height * (view.y[1] - view.y[0]);
    const marks = (element) => [...element.children].map((m) => m.getAttribute('transform').match(/-?[\d.]+/g).map(Number));
    const curves = [...svg.querySelectorAll('.curve, .trend')].map((element) => {
      const numbers = element.tagName === 'g' ? marks(element)
        : (element.getAttribute('d').match(/[-+.\de]+ [-+.\de]+/g) || []).map((pair) => pair.split(' ').map(Number));
      return { element, points: numbers.map(([x, y]) => [xAt(x), yAt(y)]) };
    });
    const axes = svg.querySelector('.axes');
    const rule = (d, strength) => make('path', { d, stroke: 'currentColor', 'stroke-opacity': strength, fill: 'none' }, axes);
    const words = (x, y, anchor, content) => { make('text', { x, y, 'text-anchor': anchor }, axes).textContent = content; };
    const tickValues = (range, count) => {
      if (!log) {
        const step = niceStep(range[1] - range[0], count), ticks = [];
        for (let k = Math.ceil(range[0] / step - 1e-9); k * step <= range[1] + 1e-9 * step; k++) ticks.push([k * step, tickLabel(k * step, step)]);
        return ticks;
      }
      const ticks = [], parts = range[1] - range[0] >= 2 ? [1] : [1, 2, 5];
      for (let k = Math.floor(range[0]); k <= range[1]; k++)
        for (const m of parts) {
          const at = k + Math.log10(m);
          if (at >= range[0] && range[1] >= at) ticks.push([at, shown(m * Math.pow(10, k))]);
        }
      return ticks;
    };
    function draw() {
      axes.replaceChildren();
      for (const [value, label] of tickValues(view.y, 6)) {
        const at = py(value);
        rule(`M ${left} ${at} H ${left + width}`, value === 0 && !log ? 0.45 : 0.13);
        words(left - 6, at + 4, 'end', label);
      }
      for (const [value, label] of tickValues(view.x, 7)) {
        const at = px(value);
        rule(`M ${at} ${top + height} v 4`, 0.6);
        words(at, top + height + 17, 'middle', label);
      }
      rule(`M ${left} ${top + height} H ${left + width}`, 0.6);
      for (const { element, points } of curves) {
        if (element.tagName === 'g') points.forEach(([x, y], k) => element.children[k].setAttribute('transform', `translate(${px(x)} ${py(y)})`));
        else element.setAttribute('d', points.map(([x, y], k) => `${k ? 'L' : 'M'} ${px(x).toFixed(2)} ${py(y).toFixed(2)}`).join(''));
      }
      plot.mark(plot.time);
    }
    const over = make('g', { 'pointer-events': 'none' }, svg);
    const cursor = make('path', { stroke: 'currentColor', 'stroke-opacity': 0.55, 'stroke-dasharray': '2 3', visibility: 'hidden' }, over);
    const now = make('path', { class: 'now', stroke: 'currentColor', 'stroke-opacity': 0.4, visibility: 'hidden' }, over);
    const box = make('rect', { y: top, height, fill: 'currentColor', 'fill-opacity': 0.1, visibility: 'hidden' }, over);
    const dots = curves.map(({ element }) => make('circle', { r: 3.6, fill: element.dataset.colour || 'none', visibility: 'hidden' }, over));
    const place = (event) => {
      const at = svg.createSVGPoint();
      [at.x, at.y] = [event.clientX, event.clientY];
      return at.matrixTransform(svg.getScreenCTM().inverse());
    };
    const inside = (p) => p.x >= left - 2 && left + width + 2 >= p.x && p.y >= top && top + height + 40 >= p.y;
    const nearest = (points, x) => {
      let best = null, least = Infinity;
      for (const p of points) {
        const d = Math.abs(p[0] - x);
        if (least > d) [best, least] = [p, d];
      }
      return best;
    };
    const hide = () => {
      for (const element of [cursor, box, ...dots]) element.setAttribute('visibility', 'hidden');
      readout.hidden = true;
    };
    const hover = (event, p) => {
      const x = Math.min(Math.max(xAt(p.x), view.x[0]), view.x[1]);
      const lines = [];
      curves.forEach(({ element, points }, k) => {
        const found = element.dataset.label === undefined ? null : nearest(points, x);
        const near = found && 40 > Math.abs(px(found[0]) - p.x);
        dots[k].setAttribute('visibility', near ? 'visible' : 'hidden');
        if (!near) return;
        dots[k].setAttribute('cx', px(found[0]));
        dots[k].setAttribute('cy', Math.min(Math.max(py(found[1]), top), top + height));
        const line = [element.dataset.colour, element.dataset.label, shown(back(found[1]))];
        // a curve and its markers are one line
        if (!lines.some((known) => known.join() === line.join())) lines.push(line);
      });
      cursor.setAttribute('d', `M ${px(x)} ${top} V ${top + height}`);
      cursor.setAttribute('visibility', 'visible');
      readout.replaceChildren();
      const head = document.createElement('b');
      head.textContent = `${svg.dataset.x.replace(/ \[.*/, '')} ${shown(back(x))} ${(svg.dataset.x.match(/\[(.*)\]/) || ['', ''])[1]}`;
      readout.appendChild(head);
      for (const [colour, label, value] of lines) {
        const line = document.createElement('div'), key = document.createElement('i');
        key.style.background = colour;
        line.append(key, ` ${value}${label ? '  ' + label : ''}`);
        readout.appendChild(line);
      }
      readout.hidden = false;
      const beyond = event.clientX + 24 + readout.offsetWidth > window.innerWidth;
      readout.style.left = `${beyond ? Math.max(event.clientX - 14 - readout.offsetWidth, 4) : event.clientX + 14}px`;
      readout.style.top = `${event.clientY + 14}px`;
    };
    let from = null;
    svg.addEventListener('pointerdown', (event) => {
      const p = place(event);
      if (event.button === 0 && event.pointerType !== 'touch' && inside(p)) {
        from = p.x;
        svg.setPointerCapture(event.pointerId);
        event.preventDefault();
      }
    });
    svg.addEventListener('pointermove', (event) => {
      const p = place(event);
      if (from !== null) {
        const [a, b] = [from, p.x].map((v) => Math.min(Math.max(v, left), left + width)).sort((u, v) => u - v);
        box.setAttribute('x', a);
        box.setAttribute('width', b - a);
        box.setAttribute('visibility', b - a > 3 ? 'visible' : 'hidden');
      }
      if (inside(p)) hover(event, p); else hide();
    });
    svg.addEventListener('pointerup', (event) => {
      if (from === null) return;
      const ends = [from, place(event).x].map((v) => xAt(Math.min(Math.max(v, left), left + width))).sort((u, v) => u - v);
      const wide = Math.abs(place(event).x - from) > 8;
      from = null;
      hide();
      if (!wide) {
        const seconds = secondsPer(svg.dataset.x);
        if (seconds) document.dispatchEvent(new CustomEvent('gototime', { detail: seconds * ends[0] }));
        return;
      }
      const seen = curves.flatMap((c) => c.points).filter(([x]) => x >= ends[0] && ends[1] >= x).map((p) => p[1]);
      const low = Math.min(...seen), high = Math.max(...seen), room = 0.06 * (high - low || Math.abs(high) || 1);
      view = { x: ends, y: seen.length ? [low - room, high + room] : view.y };
      draw();
    });
    svg.addEventListener('pointercancel', () => { from = null; hide(); });
    svg.addEventListener('pointerleave', hide);
    svg.addEventListener('dblclick', () => { view = full; hide(); draw(); });
    const plot = {
      time: null,
      // The cursor of the animation's time [s].
      mark(time) {
        plot.time = time;
        const seconds = secondsPer(svg.dataset.x), x = seconds ? time / seconds : NaN;
        const visible = time !== null && seconds && x >= view.x[0] && view.x[1] >= x;
        now.setAttribute('visibility', visible ? 'visible' : 'hidden');
        if (visible) now.setAttribute('d', `M ${px(x)} ${top} V ${top + height}`);
      },
    };
    svg.style.touchAction = 'pan-y';
    svg.style.cursor = 'crosshair';
    plots.push(plot);
  }
  document.querySelectorAll('svg.plot').forEach(start);
  document.addEventListener('flowtime', (event) => plots.forEach((plot) => plot.mark(event.detail)));

  // Each figure can be kept as SVG or PNG.
  document.querySelectorAll('figure[data-save]').forEach((figure) => {
    const keep = (name, address) => {
      const link = document.createElement('a');
      [link.href, link.download] = [address, name];
      link.click();
    };
    const text = () => {
      const copy = figure.querySelector('svg').cloneNode(true);
      copy.setAttribute('color', '#1d2126');
      return new XMLSerializer().serializeToString(copy);
    };
    const bar = document.createElement('span');
    bar.className = 'save';
    for (const kind of ['SVG', 'PNG']) {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = kind;
      button.title = `Save this figure as ${kind}`;
      button.addEventListener('click', () => {
        const name = `${figure.dataset.save}.${kind.toLowerCase()}`;
        const address = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text())}`;
        if (kind === 'SVG') return keep(name, address);
        const image = new Image(), box = figure.querySelector('svg').viewBox.baseVal;
        image.onload = () => {
          const canvas = document.createElement('canvas');
          [canvas.width, canvas.height] = [2.5 * box.width, 2.5 * box.height];
          const paint = canvas.getContext('2d');
          paint.fillStyle = '#ffffff';
          paint.fillRect(0, 0, canvas.width, canvas.height);
          paint.drawImage(image, 0, 0, canvas.width, canvas.height);
          keep(name, canvas.toDataURL('image/png'));
        };
        image.width = box.width;
        image.src = address;
      });
      bar.appendChild(button);
    }
    figure.querySelector('figcaption').appendChild(bar);
  });
})();
