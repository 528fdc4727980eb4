// The animation of the flow: particles on a canvas, between the frames by linear interpolation.
(() => {
  const player = document.getElementById('player'), blob = document.getElementById('flow-data');
  if (!player || !blob || !('DecompressionStream' in window)) return;
  const head = JSON.parse(document.getElementById('flow-head').textContent);
  const canvas = player.querySelector('canvas'), paint = canvas.getContext('2d');
  const scrub = player.querySelector('.scrub'), clock = player.querySelector('.clock'), playButton = player.querySelector('.play');
  const count = head.particles, frames = head.times.length;
  const colour = new Uint32Array(256);
  for (let k = 0; 256 > k; k++) {
    const at = k / 255 * (head.colours.length - 1), low = Math.min(Math.floor(at), head.colours.length - 2), share = at - low;
    const [a, b] = [head.colours[low], head.colours[low + 1]].map((c) => [1, 3, 5].map((i) => parseInt(c.slice(i, i + 2), 16)));
    const [red, green, blue] = a.map((v, i) => Math.round(v + share * (b[i] - v)));
    colour[k] = (255 * 16777216 + blue * 65536 + green * 256 + red) >>> 0;
  }
  let data = null, at = head.still, playing = false, value = 'pressure', whole = false, last = 0;

  async function unpack() {
    const text = atob(blob.textContent.trim()), packed = new Uint8Array(text.length);
    for (let k = 0; k !== text.length; k++) packed[k] = text.charCodeAt(k);
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    let next = 0;
    const take = (n) => bytes.subarray(next, next += n);
    const x = [], y = [], pressure = [], speed = [], size = [];
    const words = (before) => {
      const low = take(count), high = take(count), now = new Uint16Array(count);
      for (let k = 0; k !== count; k++) now[k] = (before ? before[k] : 0) + low[k] + 256 * high[k];
      return now;
    };
    const small = (before) => {
      const change = take(count), now = new Uint8Array(count);
      for (let k = 0; k !== count; k++) now[k] = (before ? before[k] : 0) + change[k];
      return now;
    };
    for (let f = 0; f !== frames; f++) {
      x.push(words(x[f - 1]));
      y.push(words(y[f - 1]));
      pressure.push(small(pressure[f - 1]));
      speed.push(small(speed[f - 1]));
      size.push(small(size[f - 1]));
    }
    const floats = new Float32Array(bytes.slice(next).buffer);
    let point = 0;
    const outlines = head.outlines.map((loops) => loops.map((n) => floats.subarray(2 * point, 2 * (point += n))));
    const metres = Float32Array.from({ length: 256 }, (_, k) => head.size[0] * Math.pow(head.size[1] / head.size[0], k / 255));
    data = { metres, x, y, pressure, speed, size, outlines };
  }

  const camera = (time) => {
    if (whole) return head.whole;
    const low = Math.min(Math.floor(time), frames - 1), high = Math.min(low + 1, frames - 1), share = time - low;
    return head.cameras[low].map((v, k) => v + share * (head.cameras[high][k] - v));
  };

  function draw() {
    const width = canvas.width, height = canvas.height;
    const low = Math.min(Math.floor(at), frames - 1), high = Math.min(low + 1, frames - 1), share = at - low;
    const [middle, centre, span] = camera(at);
    const shape = whole ? Math.max(span, head.wholeHeight * head.aspect) : span;
    const scale = width / shape, left = middle - 0.5 * shape, top = centre + 0.5 * shape * height / width;
    const image = paint.createImageData(width, height), pixels = new Uint32Array(image.data.buffer);
    const near = new Float32Array(width * height).fill(Infinity);
    const [xlow, ylow, xhigh, yhigh] = head.box, xs = (xhigh - xlow) / 65534, ys = (yhigh - ylow) / 65534;
    const [xa, xb, ya, yb, va, vb] = [data.x[low], data.x[high], data.y[low], data.y[high], data[value][low], data[value][high]];
    const sides = head.mirror ? [1, -1] : [1], sizes = data.size[low];
    // discs end at the walls; those of coarse particles at the surface, a nearly still row, are cut above
    const [wallLeft, wallRight, bottom] = [(head.tank[0] - left) * scale, (head.tank[1] - left) * scale, (top - head.tank[2]) * scale];
    const [first, last, deepest] = [Math.max(Math.ceil(wallLeft - 0.5), 0), Math.min(Math.floor(wallRight - 0.5), width - 1), Math.min(Math.floor(bottom - 0.5), height - 1)];
    for (let k = 0; k !== count; k++) {
      if (xa[k] === 65535) continue;
      const gone = xb[k] === 65535, part = gone ? 0 : share;
      const x = xlow + xs * (xa[k] + part * (xb[k] - xa[k])), y = ylow + ys * (ya[k] + part * (yb[k] - ya[k]));
      const paintAs = colour[Math.round(va[k] + part * (vb[k] - va[k]))];
      const spacing = Math.max(data.metres[sizes[k]] * scale, 1), radius = 0.8 * spacing, size = data.metres[sizes[k]], above = size > 1.3 * head.size[0] && y > -0.7 * size ? 0.56 * spacing : radius, r2 = radius * radius, s2 = 1 / (spacing * spacing);
      const cy = (top - y) * scale;
      for (const side of sides) {
        const cx = (side * x - left) * scale;
        const r0 = Math.max(Math.ceil(cy - above - 0.5), 0), r1 = Math.min(Math.floor(cy + radius - 0.5), deepest);
        for (let row = r0; row <= r1; row++) {
          const dy = row + 0.5 - cy, half = Math.sqrt(Math.max(r2 - dy * dy, 0));
          const c0 = Math.max(Math.ceil(cx - half - 0.5), first), c1 = Math.min(Math.floor(cx + half - 0.5), last);
          for (let column = c0, p = row * width + c0; column <= c1; column++, p++) {
            const dx = column + 0.5 - cx, distance = (dx * dx + dy * dy) * s2;
            if (near[p] > distance) { near[p] = distance; pixels[p] = paintAs; }
          }
        }
      }
    }
    paint.putImageData(image, 0, 0);
    const style = getComputedStyle(player), dot = width / canvas.clientWidth;
    const to = (x, y) => [(x - left) * scale, (top - y) * scale];
    const [a, b, floor, rim] = head.tank;
    paint.strokeStyle = style.getPropertyValue('--quiet');
    paint.lineWidth = 2 * dot;
    paint.beginPath();
    [[a, rim], [a, floor], [b, floor], [b, rim]].forEach(([x, y], k) => k ? paint.lineTo(...to(x, y)) : paint.moveTo(...to(x, y)));
    paint.stroke();
    if (count === 0) {
      paint.beginPath();
      paint.moveTo(...to(a, 0));
      paint.lineTo(...to(b, 0));
      paint.stroke();
    }
    const here = data.outlines[low], there = data.outlines[high];
    const same = here.length === there.length && here.every((loop, k) => loop.length === there[k].length);
    const line = (loop, next, side, from, end) => {
      paint.beginPath();
      for (let k = from; k <= end; k++) {
        const i = 2 * (k % (loop.length / 2)), part = same ? share : 0;
        const p = to(side * (loop[i] + part * (next[i] - loop[i])), loop[i + 1] + part * (next[i + 1] - loop[i + 1]));
        if (k === from) paint.moveTo(...p); else paint.lineTo(...p);
      }
    };
    here.forEach((loop, k) => {
      const next = same ? there[k] : loop, corners = loop.length / 2;
      for (const side of sides) {
        line(loop, next, side, 0, corners);
        paint.fillStyle = style.getPropertyValue('--body');
        paint.fill();
      }
      for (const side of sides) {
        line(loop, next, side, 0, corners);
        paint.strokeStyle = style.getPropertyValue('--ink');
        paint.lineWidth = 1.4 * dot;
        paint.stroke();
      }
    });
    here.forEach((loop, k) => {
      const next = same ? there[k] : loop, corners = loop.length / 2;
      for (const side of sides) {
        for (const [, from, end] of head.panels[low].filter((panel) => panel[0] === k && corners > panel[2] % corners)) {
          line(loop, next, side, from, end);
          paint.strokeStyle = '#d55e00';
          paint.lineWidth = 3.2 * dot;
          paint.stroke();
        }
      }
    });
    const time = head.times[low] + share * (head.times[high] - head.times[low]);
    clock.textContent = `${(1e3 * time).toFixed(head.decimals)} ms`;
    const metres = (w) => { const d = Math.pow(10, Math.floor(Math.log10(w))); return ([5, 2].find((m) => w >= m * d) || 1) * d; };
    const bar = metres(0.2 * shape), ruler = player.querySelector('.ruler');
    ruler.style.width = `${bar / shape * 100}%`;
    ruler.firstElementChild.textContent = bar >= 1 ? `${bar} m` : `${Math.round(1e3 * bar)} mm`;
    scrub.value = at;
    scrub.setAttribute('aria-valuetext', clock.textContent);
    player.dataset.at = at.toFixed(3);
    document.dispatchEvent(new CustomEvent('flowtime', { detail: time }));
  }

  function legend() {
    const { label, ticks, top, beyond } = head.values[value];
    player.querySelector('.ramp').classList.toggle('beyond', beyond);
    player.querySelector('.value').textContent = label;
    const marks = player.querySelector('.ticks');
    marks.replaceChildren();
    for (const [v, words] of ticks) {
      const mark = document.createElement('span');
      mark.textContent = words;
      mark.style.left = `${v / top * 100}%`;
      marks.appendChild(mark);
    }
  }

  function fit() {
    const wide = Math.round(canvas.clientWidth * Math.min(window.devicePixelRatio || 1, 2));
    if (wide === 0 || wide === canvas.width) return;
    canvas.width = wide;
    canvas.height = Math.round(wide / head.aspect);
    draw();
  }

  const perSecond = (frames - 1) / 6;
  function step(now) {
    if (!playing) return;
    at += last ? Math.min(now - last, 100) / 1000 * perSecond : 0;
    last = now;
    if (at >= frames - 1) { at = frames - 1; play(false); }
    draw();
    if (playing) requestAnimationFrame(step);
  }
  function play(on) {
    playing = on;
    last = 0;
    playButton.textContent = on ? 'Pause' : 'Play';
    playButton.setAttribute('aria-pressed', on);
    if (on && at >= frames - 1) at = 0;
    if (on) requestAnimationFrame(step);
  }
  const go = (to) => { play(false); at = Math.min(Math.max(to, 0), frames - 1); draw(); };

  unpack().then(() => {
    document.documentElement.classList.add('animated');
    scrub.max = frames - 1;
    playButton.addEventListener('click', () => play(!playing));
    player.querySelector('.back').addEventListener('click', () => go(Math.ceil(at) - 1));
    player.querySelector('.next').addEventListener('click', () => go(Math.floor(at) + 1));
    scrub.addEventListener('input', () => go(Number(scrub.value)));
    player.querySelector('.colours').addEventListener('change', (event) => { value = event.target.value; legend(); draw(); });
    player.querySelector('.views').addEventListener('change', (event) => { whole = event.target.value === 'whole'; draw(); });
    document.addEventListener('gototime', (event) => {
      const t = event.detail, k = Math.max(head.times.findIndex((v) => v >= t), 0);
      const gap = k ? head.times[k] - head.times[k - 1] : 1;
      go(k ? k - (head.times[k] - t) / gap : 0);
    });
    window.addEventListener('resize', fit);
    if (count === 0) player.querySelectorAll('.colours, .legend').forEach((element) => element.remove());
    else legend();
    fit();
  }).catch((error) => { player.dataset.error = String(error); });
})();
