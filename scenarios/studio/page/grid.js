/* One or two ranges of keys: a chart or a table. */
const grid = {
  form: $("grid"), id: null, last: null,

  begin() {
    for (const model of MODELS) this.form.model.append(make("option", { value: model }, TITLES[model])); this.form.model.value = "boundary_element";
    for (const [name, title] of [["peak_force_N_per_m", "peak force"], ["peak_acceleration_g", "peak acceleration"], ["impulse_N_s_per_m", "impulse"]]) this.form.result.append(make("option", { value: name }, title));
  },

  /** Offer the keys of the scene that are numbers. */
  show(written) {
    const keys = Object.entries(written).flatMap(([key, text]) => {
      const numbers = numeric(text) || [];
      return /^\[/.test(text) ? numbers.map((value, k) => [`${key}[${k}]`, value]) : numbers.map((value) => [key, value]);
    }).filter(([key]) => !/^(resolution|tank|time|gauges|compare)/.test(key));
    this.numbers = new Map(keys);
    for (const k of [1, 2]) {
      const select = this.form[`key${k}`], before = select.value;
      select.replaceChildren(...(k === 2 ? [make("option", { value: "" }, "none")] : []), ...keys.map(([key]) => make("option", { value: key }, fields.title(key))));
      const usual = keys.find(([key]) => /deadrise/.test(key)) || keys.find(([key, value]) => /velocity/.test(key) && value !== 0) || keys[0];
      select.value = this.numbers.has(before) || before === "" ? before : "";
      if (k === 1 && !select.value && usual) { select.value = usual[0]; this.usual(1); }
    }
    this.mark();
  },
  /** What a table holds for: the choices, and the scene without what they change. */
  state() {
    const { form } = this, own = { ...scene.written }, keys = [1, 2].map((k) => form[`key${k}`].value);
    for (const key of ["model", "solver", "want", "within", "name", "description", ...keys]) delete own[key];
    for (const [, path, k] of keys.map((key) => key.match(/^(.*)\[(\d+)\]$/) || [])) if (own[path]) own[path] = parts(own[path]).map((part, i) => (i === +k ? "" : part)).join();
    const numbers = [1, 2].flatMap((k) => (keys[k - 1] ? ["from", "to", "count"].map((name) => form[name + k].value) : []));
    return JSON.stringify([form.model.value, keys, numbers, own]);
  },
  /** Mark what was computed for another scene or other choices. */
  mark() {
    const old = Boolean(this.last) && this.of !== this.state(); $("grid_old").hidden = !old; $("grid_out").classList.toggle("old", old);
  },
  /** Ends of a range about the scene's value. */
  usual(k) {
    const value = this.numbers.get(this.form[`key${k}`].value);
    const ends = value === undefined ? ["", ""] : value === 0 ? ["0", "1"] : [plain(0.7 * value), plain(1.3 * value)];
    [this.form[`from${k}`].value, this.form[`to${k}`].value] = ends;
  },

  async start() {
    const number = (name) => (NUMBER.test(this.form[name].value.trim()) ? +this.form[name].value : NaN);
    const ranges = [1, 2].filter((k) => this.form[`key${k}`].value)
      .map((k) => ({ key: this.form[`key${k}`].value, from: number(`from${k}`), to: number(`to${k}`), count: number(`count${k}`) }));
    this.stop().catch(() => {}); this.id = this.last = null; $("grid_error").textContent = $("grid_progress").textContent = "";
    $("grid_out").replaceChildren(); this.mark();
    const wrong = ranges.map((range) => (![range.from, range.to].every(Number.isFinite) || !Number.isInteger(range.count) || range.count < 1
      ? `Expected numbers from and to with a decimal point and without a unit${fields.word(range.key)?.unit ? `, in ${fields.word(range.key).unit}` : ""}, and a whole number of values.` : ""));
    if (ranges[1]?.key === ranges[0].key) wrong[1] = `${fields.title(ranges[1].key)} is the first key: expected another.`;
    for (const k of [1, 2]) complain(this.form[`key${k}`], `grid_error${k}`, wrong[k - 1] || ""); if (wrong.some(Boolean)) return;
    this.of = this.state(); const { id, error } = await ask("/api/grid", { text: scene.text, model: this.form.model.value, ranges });
    if (error) { $("grid_error").textContent = fields.words(error); return; }
    this.id = id; this.look(id);
  },
  async stop() { if (this.id) await ask(`/api/grid/stop?id=${this.id}`, {}); },

  async look(id) {
    if (id !== this.id) return; const found = (this.last = await ask(`/api/grid?id=${id}`));
    const going = found.done < found.points.length && !found.stopped; $("grid_stop").disabled = !going;
    $("grid_progress").textContent = `${found.done} of ${found.points.length}${going ? "" : found.done < found.points.length ? ", stopped" : " done"}`;
    this.draw(); if (going) setTimeout(() => this.look(id).catch(() => { $("grid_progress").textContent += ", not followed to its end"; }), 250);
  },

  draw() {
    if (!this.last) return; const { ranges, points } = this.last, name = this.form.result.value;
    const of = (point) => point?.results?.find((result) => result.name === name);
    const values = points.map((point) => of(point)?.value).filter((value) => value != null), top = Math.max(...values.map(Math.abs), 1e-300);
    const places = ranges.length === 2 ? ranges[0].values.flatMap((a) => ranges[1].values.map((b) => [a, b])) : ranges[0].values.map((a) => [a]);
    const cell = (k) => {
      const point = points[k], result = of(point); if (!point) return make("td", {}, "…");
      if (!result) return make("td", {}, make("small", {}, fields.words(point.why || "–")));
      const take = () => change(ranges.map((range, i) => ({ key: range.key, value: plain(places[k][i]) })));
      const node = make("td", { class: "value" }, make("button", { class: "cell", type: "button", title: `${result.verdict_words}; take these values into the scene`, onclick: take }, result.text.replace("withheld: its band is as large as itself", "withheld"), result.verdict === "resolved" ? "" : make("small", {}, ` ${result.verdict_words}`)));
      if (result.value != null) node.style.background = `color-mix(in srgb, var(--c1) ${Math.round((40 * Math.abs(result.value)) / top)}%, transparent)`;
      return node;
    };
    const out = [], titles = ranges.map(({ key }) => fields.title(key));
    if (ranges.length === 1) {
      const x = ranges[0].values, y = points.map((point) => of(point)?.value ?? null), result = points.map(of).find(Boolean);
      const band = (sign) => points.map((point) => { const own = of(point); return own?.value != null && own.band != null ? own.value + sign * own.band : null; });
      if (result) out.push(chart(result.title, titles[0], fields.word(ranges[0].key)?.unit || "-", [{ name: result.title, colour: "var(--c0)", x, y, si: result.si }], [{ x, low: band(-1), high: band(1), colour: "var(--c0)" }]) || "");
      out.push(make("table", {}, make("tbody", {}, ...x.map((value, k) => make("tr", {}, make("th", { scope: "row" }, `${titles[0]} = ${plain(value)}`), cell(k))))));
    } else {
      const columns = ranges[1].values;
      const head = make("tr", {}, make("th", {}, titles.join(" \\ ")), ...columns.map((value) => make("th", { scope: "col" }, plain(value))));
      const rows = ranges[0].values.map((value, i) => make("tr", {}, make("th", { scope: "row" }, plain(value)), ...columns.map((_, j) => cell(i * columns.length + j))));
      out.push(make("table", {}, make("caption", {}, "A cell takes its values into the scene."), make("thead", {}, head), make("tbody", {}, ...rows)));
    }
    $("grid_out").replaceChildren(...out); markWide($("grid_out")); this.mark();
  },
};

$("grid").addEventListener("submit", (event) => { event.preventDefault(); grid.start().catch((error) => { $("grid_error").textContent = error.message; }); });
$("grid_stop").addEventListener("click", () => grid.stop());
$("grid").addEventListener("input", () => grid.mark());
$("grid").result.addEventListener("change", () => grid.draw());
for (const k of [1, 2]) $("grid")[`key${k}`].addEventListener("change", () => { grid.usual(k); grid.mark(); });
