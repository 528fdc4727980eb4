/* Curves and numbers of all models. */
const MODELS = ["von_karman", "wagner", "mlm", "similarity", "boundary_element"];
const HUES = Object.fromEntries(MODELS.map((model, k) => [model, `var(--c${k})`]));
const answers = {
  all: new Map(), hidden: new Set(), wanted: null, quoted: null, tallest: 0,

  /** Ask for the answers to a text; what is still computed for an earlier one is no longer wanted. */
  async ask(text) {
    this.wanted?.abort(); const wanted = (this.wanted = new AbortController()), start = performance.now(); this.flowing = true;
    for (const model of MODELS) if (this.all.has(model)) this.all.get(model).old = true;
    // what is late is seen to be old
    const late = setTimeout(() => this.show(), 150);
    try {
      const formulas = await ask("/api/theories", { text }, wanted.signal); for (const answer of formulas) this.all.set(answer.model, answer);
      $("took").textContent = `theories in ${Math.round(performance.now() - start)} ms`; this.show();
      const answer = await ask("/api/flow", { text, page: pageId }, wanted.signal); if (answer.stale) return; this.flowing = false;
      this.all.set("boundary_element", answer); this.show();
    } catch (error) {
      if (error.name === "AbortError") return; this.flowing = false; notice(`The scene was not computed: ${error.message}.`);
    } finally { clearTimeout(late); }
  },

  forget(key) { if (this.all.delete(key)) this.show(); },
  add(key, answer) { this.all.set(key, answer); this.show(); },

  /** Answers that hold for the present text, the one to quote first. */
  ranked() {
    const rank = ([key, answer]) => {
      const quote = answer.quote; if (!answer.ok || answer.old || !quote || quote.value == null) return Infinity;
      if (quote.verdict === "resolved") return quote.share ?? 1;
      const detailed = key.startsWith("run ") ? 0 : key === "boundary_element" ? 1 : 2 + MODELS.length - MODELS.indexOf(key);
      return { no_band: 10, acoustic: 20, not_resolved: 30 }[quote.verdict] + detailed;
    };
    return [...this.all].map((entry) => [rank(entry), ...entry]).filter(([rank]) => rank < Infinity).sort((a, b) => a[0] - b[0]);
  },

  show() {
    const [best] = this.ranked(); this.quote(best?.[2]);
    const colour = (key) => HUES[key] || `var(--c${5 + ([...this.all.keys()].filter((own) => own.startsWith("run ")).indexOf(key) % 3)})`;
    const drawn = [...this.all].filter(([, answer]) => answer.ok && !answer.old);
    $("legend").replaceChildren(...drawn.map(([key, answer]) => {
      const box = make("input", { type: "checkbox", onchange: () => { this.hidden[box.checked ? "delete" : "add"](key); this.show(); } });
      box.checked = !this.hidden.has(key); const swatch = make("span", { class: "swatch" }); swatch.style.borderTopColor = colour(key);
      return make("label", {}, box, swatch, key.startsWith("run ") ? key : answer.title);
    }));
    const visible = drawn.filter(([key]) => !this.hidden.has(key));
    const titles = [...new Set(visible.flatMap(([, answer]) => answer.curves.map((curve) => curve.title)))];
    $("curves").replaceChildren(...titles.map((title) => {
      const curves = visible.flatMap(([key, answer]) => answer.curves.filter((curve) => curve.title === title)
        .map((curve) => ({ name: answer.title, colour: colour(key), x: answer.time, y: curve.values, si: curve.si })));
      return chart(title, "Time", "s", curves);
    }));
    this.table(best?.[1]);
  },

  quote(answer) {
    // while nothing holds for the present scene, the number before is shown as old
    const old = !answer && (this.flowing || scene.lost) && this.quoted, box = $("quote"), quote = (answer = this.quoted = answer || old || null)?.quote;
    const wrong = scene.lost ? "The studio does not answer: what is shown is of the last scene that it computed. Start it again where it has ended."
      : scene.error ? `The scene has a mistake: ${scene.error.message}. The number is that of the last scene without one.` : scene.implausible ? `Check the scene first: ${scene.implausible}.` : scene.notice;
    $("number").classList.toggle("old", Boolean(scene.lost || scene.error || old));
    box.className = `quote ${scene.lost ? "bad" : wrong ? "care" : !quote || old ? "" : { resolved: quote.share > 0.3 ? "care" : "good", no_band: "care" }[quote.verdict] || "bad"}`;
    const doubts = (answer?.doubts || []).map((text) => `Doubt: ${fields.words(text)}`), warnings = (scene.warnings || []).filter((text) => text !== scene.implausible);
    const put = (id, text) => { if ($(id).textContent !== text) $(id).textContent = text; }; put("number", quote ? quote.number : "–");
    put("by", old ? "of the scene before; being computed" : quote ? `${quote.by}${this.flowing ? "; boundary elements are being computed" : ""}` : this.flowing ? "being computed" : [...this.all.values()].some((own) => own.ok && !own.old) ? "No model has a peak force that can be quoted here: see the curves, or run it by particles." : "No theory follows this scene: run it by particles.");
    put("verdict", wrong ? fields.words(wrong) : (!old && quote?.verdict_in_words) || "");
    $("warnings").replaceChildren(...warnings.map((text) => make("li", {}, fields.words(text))));
    $("others").replaceChildren(...[...(quote?.others || []), ...doubts].map((text) => make("li", {}, text)));
    // what is below stays in its place
    box.style.minHeight = ""; this.tallest = Math.max(this.tallest, box.offsetHeight); box.style.minHeight = `${this.tallest}px`;
  },

  table(best) {
    const cell = (answer, name) => {
      const found = answer.results.find((result) => result.name === name);
      return make("td", { class: "value" }, found ? found.text : "–", found && found.verdict !== "resolved" ? make("small", {}, ` ${found.verdict_words}`) : "");
    };
    const row = (key, title, ...cells) => make("tr", { class: this.all.get(key)?.old ? "old" : key === best ? "best" : "" }, make("th", { scope: "row" }, title), ...cells);
    const rows = [...this.all].filter(([, answer]) => answer.ok).map(([key, answer]) =>
      row(key, (key.startsWith("run ") ? `${key}, ${answer.title}` : answer.title) + (answer.old ? ": being computed" : ""), cell(answer, "peak_force_N_per_m"), cell(answer, "peak_acceleration_g")));
    const silent = Map.groupBy([...this.all.values()].filter((answer) => !answer.ok), (answer) => (answer.old ? "being computed" : fields.words(answer.why)));
    for (const [why, models] of silent) rows.push(row(null, models.map((answer) => answer.title).join(", "), make("td", { colspan: 2 }, make("small", {}, why))));
    const head = make("tr", {}, ...["Model", "Peak force", "Peak acceleration"].map((title) => make("th", { scope: "col" }, title)));
    $("models").replaceChildren(make("thead", {}, head), make("tbody", {}, ...rows)); markWide($("models").parentNode);
  },
};

/** Width of a drawing, so that its letters are read on a narrow page too [pixels]. */
const room = () => Math.max(320, Math.min(720, $("curves").clientWidth || 640));

/** Ticks of an axis: round numbers. */
function ticks(low, high, count) {
  const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map((k) => k * power).find((own) => own >= raw);
  const found = []; for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k += 1) found.push(k * step); return found;
}

/** Curves over a common axis; the place under the pointer is read out. */
function chart(title, xTitle, xSi, curves, bands = []) {
  const width = room(), height = 240, [left, right, top, bottom] = [64, 12, 12, 36];
  const finite = (values) => values.filter((value) => value != null && Number.isFinite(value));
  const bounds = (values) => {
    const [low, high] = [Math.min(...values), Math.max(...values)]; return high > low ? [low, high] : [low - 1, high + 1];
  };
  const xs = curves.flatMap((curve) => finite(curve.x)), ys = curves.flatMap((curve) => finite(curve.y)).concat(bands.flatMap((band) => [...finite(band.low), ...finite(band.high)]));
  if (!xs.length || !ys.length) return ""; const si = curves[0].si, [x0, x1] = bounds(xs), [y0, y1] = bounds([0, ...ys]);
  const [ux, uy] = [unitFor(xSi, Math.max(Math.abs(x0), Math.abs(x1))), unitFor(si, Math.max(Math.abs(y0), Math.abs(y1)))];
  const px = (x) => left + ((x - x0) / (x1 - x0)) * (width - left - right), py = (y) => height - bottom - ((y - y0) / (y1 - y0)) * (height - top - bottom);
  const heading = `${title} [${uy.name || "–"}] over ${xTitle.toLowerCase()} [${ux.name || "–"}]`;
  const svg = make("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": heading });
  for (const x of ticks(x0 * ux.scale, x1 * ux.scale, width / 100)) {
    const at = px(x / ux.scale);
    svg.append(make("line", { class: "axis", x1: at, x2: at, y1: top, y2: height - bottom }), make("text", { x: at, y: height - bottom + 15, "text-anchor": "middle" }, digits(x)));
  }
  for (const y of ticks(y0 * uy.scale, y1 * uy.scale, 4)) {
    const at = py(y / uy.scale);
    svg.append(make("line", { class: "axis", x1: left, x2: width - right, y1: at, y2: at }), make("text", { x: left - 6, y: at + 4, "text-anchor": "end" }, digits(y)));
  }
  svg.append(make("rect", { class: "frame", x: left, y: top, width: width - left - right, height: height - top - bottom }));
  svg.append(make("text", { x: (left + width - right) / 2, y: height - 4, "text-anchor": "middle" }, `${xTitle} [${ux.name || "–"}]`));
  for (const { x, low, high, colour } of bands) {
    for (const side of [low, high]) svg.append(make("path", { d: path(x, side, px, py), stroke: colour, "stroke-dasharray": "4 4" }));
  }
  for (const curve of curves) svg.append(make("path", { d: path(curve.x, curve.y, px, py), stroke: curve.colour }));
  const cursor = make("line", { class: "axis", y1: top, y2: height - bottom, visibility: "hidden" }), readout = make("figcaption", { class: "hint" }, " ");
  svg.append(cursor);
  const nearest = (values, x) => values.reduce((best, value, k) => (Math.abs(value - x) < Math.abs(values[best] - x) ? k : best), 0);
  svg.addEventListener("pointermove", (event) => {
    const box = svg.getBoundingClientRect(), at = ((event.clientX - box.left) * width) / box.width;
    const x = x0 + ((at - left) / (width - left - right)) * (x1 - x0); if (x < x0 || x > x1) return;
    for (const side of ["x1", "x2"]) cursor.setAttribute(side, at); cursor.setAttribute("visibility", "visible");
    readout.textContent = `${withUnit(x, xSi)}: ${curves.map((curve) => `${curve.name} ${withUnit(curve.y[nearest(curve.x, x)] ?? NaN, si)}`).join(", ")}`;
  });
  svg.addEventListener("pointerleave", () => { cursor.setAttribute("visibility", "hidden"); readout.textContent = " "; });
  return make("figure", { class: "chart" }, make("b", {}, `${title} [${uy.name || "–"}]`), svg, readout);
}

/** The line through points; gaps where there is no number. */
function path(x, y, px, py) {
  let pen = "M", d = "";
  x.forEach((value, k) => {
    if (y[k] == null || !Number.isFinite(y[k])) { pen = "M"; return; }
    d += `${pen}${px(value).toFixed(1)},${py(y[k]).toFixed(1)}`; pen = "L";
  });
  return d;
}
