/* The section as a drawing; the points of an outline are moved, added and removed. */
const section = {
  host: $("section"), points: null, chosen: 0, dragging: null, shown: null, body: null,
  margin: 46,

  /** Show the section of a scene. */
  show(shown) {
    this.shown = shown;
    // place and scale stay while a point is dragged
    if (this.dragging) return; this.body = shown && shown.own ? shown.bodies[0] : null;
    this.points = this.body && ["polygon", "polyline"].includes(this.body.shape) ? this.body.points.map((p) => [...p]) : null;
    if (this.points) $("mirror").disabled = !this.symmetric(); this.draw();
  },

  /** Whether each point has its mirror image. */
  symmetric() { return this.points.every((_, k) => this.image(k) >= 0); },
  size() {
    const xs = this.points.map((p) => p[0]), ys = this.points.map((p) => p[1]);
    return Math.max(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys), 1e-9);
  },
  mirrored() { return $("mirror").checked && !$("mirror").disabled; },
  /** The index of a point's mirror image, itself on the axis; −1 without one. */
  image(k) {
    const [x, y] = this.points[k], near = 1e-6 * this.size();
    return this.points.findIndex((p) => Math.abs(p[0] + x) < near && Math.abs(p[1] - y) < near);
  },

  frame() {
    const { bodies, tank } = this.shown; this.width = room(); let all = bodies.flatMap((body) => body.outline);
    if (!all.length) all = [[-tank.width / 2, -tank.depth], [tank.width / 2, tank.height - tank.depth]];
    const [xs, ys] = [0, 1].map((i) => all.map((p) => p[i]));
    let [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys, 0), Math.max(...ys)];
    const scale = (this.width - 2 * this.margin) / Math.max(right - left, 1.6 * (high - low), 1e-9); const middle = (left + right) / 2;
    const height = Math.max(160, scale * (high - low) + 2 * this.margin);
    return { scale, height, to: ([x, y]) => [this.width / 2 + scale * (x - middle), this.margin + scale * (high - y)],
      from: ([px, py]) => [middle + (px - this.width / 2) / scale, high - (py - this.margin) / scale] };
  },
  toTank([x, y]) {
    const a = (this.body.angle_deg * Math.PI) / 180, [px, py] = this.body.position;
    return [px + Math.cos(a) * x - Math.sin(a) * y, py + Math.sin(a) * x + Math.cos(a) * y];
  },
  toBody([x, y]) {
    const a = (this.body.angle_deg * Math.PI) / 180, [dx, dy] = [x - this.body.position[0], y - this.body.position[1]];
    return [Math.cos(a) * dx + Math.sin(a) * dy, -Math.sin(a) * dx + Math.cos(a) * dy];
  },
  /** The place under the pointer, in the body's frame. */
  under(event, frame) {
    const box = this.host.querySelector("svg").getBoundingClientRect(), scale = this.width / box.width;
    return this.toBody(frame.from([(event.clientX - box.left) * scale, (event.clientY - box.top) * scale]));
  },

  draw() {
    $("as_points").hidden = !this.body || !!this.points;
    for (const id of ["add_point", "remove_point", "point_x", "point_y", "mirror"]) $(id).closest("label, button").hidden = !this.points;
    $("section_hint").textContent = this.points
      ? "Drag a point, or reach it with Tab and move it with the arrow keys (Shift: ten steps). Insert adds a point after it, Delete removes it. A double click on a side adds one there."
      : this.body ? "The shape follows its keys below. As points it can be drawn freely." : "";
    if (!this.shown) return this.host.replaceChildren();
    const focused = document.activeElement?.dataset?.point, shown = this.dragging?.shown || this.shown;
    const frame = this.dragging?.frame || this.frame(), { to, height, scale } = frame; this.last = frame;
    const line = (points) => points.map((p) => to(p).map((v) => v.toFixed(2)).join(",")).join(" ");
    const svg = make("svg", { viewBox: `0 0 ${this.width} ${height.toFixed(0)}`, role: "group", "aria-label": "Drawing of the section" });
    const surface = to([0, 0])[1];
    svg.append(make("rect", { class: "water", x: 0, y: surface, width: this.width, height: Math.max(0, height - surface) }));
    svg.append(make("text", { x: 6, y: surface - 5 }, "still water"));
    shown.bodies.forEach((body, k) => {
      const moved = k === 0 && this.points && body.shape === "polygon"; const outline = moved ? this.points.map((p) => this.toTank(p)) : body.outline;
      const shape = make("polygon", { class: "body", points: line(outline) });
      if (moved) shape.addEventListener("dblclick", (event) => this.addAt(event)); svg.append(shape);
      body.panels.forEach((panel) => svg.append(make("polyline", { class: "panel", points: line(panel.line) }, make("title", {}, `panel ${panel.name}`))));
    });
    for (const gauge of shown.gauges) {
      const [x, y] = to(gauge.at);
      svg.append(make("path", { class: "gauge", d: `M${x - 5},${y}h10M${x},${y - 5}v10` }), make("text", { x: x + 6, y: y + 16 }, gauge.name));
    }
    if (this.body) {
      const [w, unit] = [Math.max(...this.body.outline.map((p) => p[0])) - Math.min(...this.body.outline.map((p) => p[0])), "m wide"];
      svg.append(make("text", { x: 6, y: 16 }, `${digits(w)} ${unit}, ${digits(-this.body.velocity[1])} m/s down`));
    }
    const bar = 10 ** Math.floor(Math.log10(150 / scale)), length = bar * scale;
    svg.append(make("path", { class: "gauge", d: `M${this.width - 12 - length},${height - 10}h${length}` }), make("text", { x: this.width - 12 - length, y: height - 15 }, `${digits(bar)} m`));
    (this.points || []).forEach((p, k) => svg.append(this.handle(k, to(this.toTank(p))))); this.host.replaceChildren(svg);
    if (focused !== undefined) svg.querySelector(`[data-point="${this.chosen}"]`)?.focus({ preventScroll: true }); this.showPoint();
  },

  handle(k, [x, y]) {
    const [px, py] = this.points[k];
    const node = make("circle", {
      class: `handle${k === this.chosen ? " chosen" : ""}`, cx: x.toFixed(2), cy: y.toFixed(2), r: this.points.length > 60 ? 4 : 6.5, tabindex: 0, role: "button",
      "data-point": k, "aria-label": `Point ${k + 1} of ${this.points.length}: x ${digits(px)} m, y ${digits(py)} m`,
    });
    node.addEventListener("focus", () => { this.choose(k); }); node.addEventListener("pointerdown", (event) => this.grab(event, k));
    node.addEventListener("keydown", (event) => this.key(event, k)); return node;
  },

  choose(k) {
    this.chosen = k; this.host.querySelectorAll(".handle").forEach((node) => node.classList.toggle("chosen", +node.dataset.point === k));
    this.showPoint();
  },
  showPoint() {
    if (!this.points) return; this.chosen = Math.min(this.chosen, this.points.length - 1);
    [["point_x", 0], ["point_y", 1]].forEach(([id, i]) => { if (document.activeElement === $(id)) return; $(id).value = this.points[this.chosen][i]; complain($(id), "point_error", ""); });
  },

  /** Move a point, and its image where it is to follow; what is dragged is rounded to a step, what is typed is not. */
  move(k, at, dragged = true) {
    const step = 10 ** Math.floor(Math.log10(this.size() / 1000));
    const [x, y] = at.map((v, i) => (dragged && v !== this.points[k][i] ? +(Math.round(v / step) * step).toPrecision(8) : v));
    const image = this.mirrored() ? this.image(k) : -1; this.points[k] = [image === k ? 0 : x, y];
    if (image >= 0 && image !== k) this.points[image] = [-x, y];
  },
  grab(event, k) {
    event.preventDefault(); event.target.focus({ preventScroll: true }); this.choose(k);
    const frame = this.last, from = this.under(event, frame), [x, y] = this.points[k];
    this.dragging = { frame, shown: this.shown, gauges: new Set() }; $("quote").style.height = `${$("quote").offsetHeight}px`;
    const moved = (now) => {
      const at = this.under(now, frame); this.move(k, [x + at[0] - from[0], y + at[1] - from[1]]); this.changed();
    };
    const listening = new AbortController(), until = { signal: listening.signal };
    const ended = () => {
      listening.abort(); this.dragging = null; $("quote").style.height = "";
      // what the server says of the last place follows
      if (scene.busy || scene.error) this.draw(); else this.show(this.shown);
    };
    window.addEventListener("pointermove", moved, until);
    for (const name of ["pointerup", "pointercancel"]) window.addEventListener(name, ended, until);
  },
  key(event, k) {
    const step = (event.shiftKey ? 10 : 1) * 10 ** Math.floor(Math.log10(this.size() / 200));
    const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
    if (by) this.move(k, [this.points[k][0] + by[0], this.points[k][1] + by[1]]);
    else if (event.key === "Insert" || event.key === "+") return event.preventDefault(), this.add(k);
    else if (event.key === "Delete" || event.key === "Backspace") return event.preventDefault(), this.remove(k); else return; event.preventDefault();
    this.changed();
  },
  /** Draw what was changed, and hand it to the scene. */
  changed() {
    this.draw(); this.commit();
  },
  /** The same where points came or went: the chosen one has the focus. */
  changedCount() {
    this.changed(); this.host.querySelector(`[data-point="${this.chosen}"]`)?.focus({ preventScroll: true });
  },

  /** Add a point midway between a point and the next, or at a place; and its image. */
  add(k, place) {
    const next = (k + 1) % this.points.length; const at = place || [0, 1].map((i) => (this.points[k][i] + this.points[next][i]) / 2);
    const rounded = at.map((v) => +v.toPrecision(6));
    // the image of the side from k to next begins at the image of next
    const image = this.mirrored() ? this.image(next) : -1; if (image === k) rounded[0] = 0;
    this.points = this.points.flatMap((p, i) => (i === k ? [p, rounded] : i === image ? [p, [-rounded[0], rounded[1]]] : [p]));
    this.choose(this.points.indexOf(rounded)); this.changedCount();
  },
  addAt(event) {
    const at = this.under(event, this.last);
    const sides = this.points.map((_, k) => k).sort((a, b) => this.nearest(a, at).distance - this.nearest(b, at).distance); this.add(sides[0], at);
  },
  remove(k) {
    const image = this.mirrored() ? this.image(k) : -1; const gone = new Set([k, ...(image >= 0 ? [image] : [])]);
    if (this.points.length - gone.size < 3) return; this.points = this.points.filter((_, i) => !gone.has(i)); this.chosen = Math.max(0, k - 1);
    this.changedCount();
  },

  /** Hand the points to the scene, as written where they were; the gauges that were moved are named. */
  commit(more = [], written = null, note = "") {
    const pairs = this.points.map(([x, y]) => `[${x}, ${y}]`), lines = [], gauges = this.gauges(), names = this.dragging?.gauges ?? new Set();
    for (let k = 0; k < pairs.length; k += 6) lines.push(`    ${pairs.slice(k, k + 6).join(", ")},`);
    for (const { key } of gauges) names.add(scene.written[key.replace(/at$/, "name")] || key);
    if (names.size) note += ` The outline moved: gauge ${[...names].join(", ")} was moved to the nearest place on it.`;
    this.value = written ?? `[\n${lines.join("\n")}\n]`;
    const files = ["outline", "outline_unit", "outline_layer"].filter((key) => `body.${key}` in scene.written);
    change([...more, ...gauges, ...files.map((key) => ({ key: `body.${key}`, value: null })), { key: "body.points", value: this.value }], note);
  },
  /** Gauges on the body follow its outline: each goes to the nearest place on it. */
  gauges() {
    if (scene.written["body.shape"] === "polyline") return [];
    return Object.keys(scene.written).filter((key) => /^gauges\[\d+\]\.at$/.test(key) && scene.written[key.replace(/at$/, "on")] !== "fixed").flatMap((key) => {
      const at = numeric(scene.written[key]); if (at?.length !== 2) return [];
      const near = this.points.map((_, k) => this.nearest(k, at)).reduce((a, b) => (b.distance < a.distance ? b : a));
      return near.distance > 1e-6 * this.size() ? [{ key, value: `[${near.place.map(plain).join(", ")}]` }] : [];
    });
  },
  /** The place of a side that is nearest to a point of the body's frame. */
  nearest(k, at) {
    const a = this.points[k], b = this.points[(k + 1) % this.points.length], d = [b[0] - a[0], b[1] - a[1]];
    const t = Math.min(1, Math.max(0, ((at[0] - a[0]) * d[0] + (at[1] - a[1]) * d[1]) / (d[0] ** 2 + d[1] ** 2 || 1)));
    const place = [a[0] + t * d[0], a[1] + t * d[1]]; return { place, distance: Math.hypot(at[0] - place[0], at[1] - place[1]) };
  },
  /** An outline in place of the shape's keys. */
  replace(points, written, note) {
    this.points = points; this.chosen = 0;
    const shape = ["deadrise_deg", "breadth", "side_height", "radius", "height", "thickness"].filter((key) => `body.${key}` in scene.written);
    const kind = written && scene.written["body.shape"] === "polyline" ? "polyline" : "polygon";
    this.commit([...shape.map((key) => ({ key: `body.${key}`, value: null })), { key: "body.shape", value: kind }], written, note);
  },

  /** An outline that was typed or pasted: a list of points in brackets, or a line "x, y" for each. */
  take(text) {
    if (!/\d/.test(text)) return change([{ key: "body.points", value: text.trim() || null }]);
    if (!text.trim().startsWith("[")) return this.read("points.csv", new Blob([text]), "body.points");
    const pair = /\[\s*"?([^[\],"]+)"?\s*,\s*"?([^[\],"]+)"?\s*,?\s*\]/g, bare = text.replace(/#.*$/gm, ""), points = [...bare.matchAll(pair)].map(([, x, y]) => [length(x), length(y)]);
    if (points.length < 3 || !points.flat().every(Number.isFinite) || /[^\s,[\]]/.test(bare.replace(pair, ""))) return change([{ key: "body.points", value: text }]);
    return this.replace(points, text);
  },
  /** An outline from a table or a drawing, in the chosen unit; a mistake stands at the button, or at the key points. */
  async read(name, content, at) {
    const unit = $("import_unit").value, field = at && fields.shown.get(at), wrong = (why) => {
      if (field) field.update("", { message: why, keep: true });
      else { $("import_error").textContent = why; $("import_error").scrollIntoView({ block: "center" }); }
      notice(`${name} was not read: the number is that of the section before.`);
    };
    $("import_error").textContent = ""; if (content.size > 1e6) return wrong(`${name}: expected a file below 1 MB`);
    try {
      const { points, error, mirrored } = await ask(`/api/outline?${new URLSearchParams({ name, unit })}`, content); if (error) return wrong(error);
      const xs = points.map((p) => p[0]), half = mirrored ? ` ${name} holds one half: the other is its mirror image about x = 0.` : "";
      this.replace(points.map((p) => p.map((v) => +v.toPrecision(12))), null, `${name}: ${digits(Math.max(...xs) - Math.min(...xs))} m wide, read in ${unit || "its unit, or m"}.${half}`);
      this.source = { name, content, at, value: this.value };
    } catch (error) { wrong(error.message); }
  },
};

/** Points of a shape that are needed: those on a straight line are left out, and most of those on an arc. */
function corners(points) {
  const every = Math.ceil(points.length / 48), lowest = points.reduce((low, p, k) => (p[1] < points[low][1] ? k : low), 0);
  const turn = ([x, y], a, b) => Math.abs(Math.atan2((x - a[0]) * (b[1] - y) - (y - a[1]) * (b[0] - x), (x - a[0]) * (b[0] - x) + (y - a[1]) * (b[1] - y)));
  const needed = points.filter((p, k) => (k - lowest) % every === 0 || turn(p, points.at(k - 1), points[(k + 1) % points.length]) > 0.3);
  return needed.filter(([x, y], k) => {
    const [a, b] = [needed.at(k - 1), needed[(k + 1) % needed.length]];
    return Math.abs((x - a[0]) * (b[1] - a[1]) - (y - a[1]) * (b[0] - a[0])) > 1e-9 * Math.hypot(b[0] - a[0], b[1] - a[1]) ** 2;
  });
}

$("as_points").addEventListener("click", () => {
  section.points = corners(section.body.points.map((p) => p.map((v) => +v.toPrecision(6)))); section.replace(section.points);
});
$("add_point").addEventListener("click", () => section.add(section.chosen));
$("remove_point").addEventListener("click", () => section.remove(section.chosen));
for (const [id, i] of [["point_x", 0], ["point_y", 1]]) {
  $(id).addEventListener("change", () => {
    const value = length($(id).value), at = [...section.points[section.chosen]], onAxis = i === 0 && section.mirrored() && section.image(section.chosen) === section.chosen;
    const wrong = Number.isNaN(value) ? "Expected a number in m with a decimal point, or one with a unit such as 60 mm." : onAxis && value !== 0 ? "This point is on the axis: its x is 0 while the mirror image is moved too." : "";
    complain($(id), "point_error", wrong); if (wrong) return; $(id).value = at[i] = value; section.move(section.chosen, at, false); section.changed();
  });
}
$("import").addEventListener("change", async (event) => {
  const [file] = event.target.files; event.target.value = "";
  // the content is kept, to be read anew in another unit
  if (file) section.read(file.name, new Blob([await file.arrayBuffer()]));
});
$("import_unit").addEventListener("change", () => {
  const { source } = section; if (source && source.value === scene.written["body.points"]) section.read(source.name, source.content, source.at);
  else if (source) $("section_note").textContent = "The unit is that of the next import: the points were changed since the last.";
});
