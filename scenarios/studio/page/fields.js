/* A field for each key of the scene, from its schema: unit, default, allowed values, slider, the error at its place. */
const fields = {
  host: $("fields"), keywords: new Map(), shown: new Map(), order: "", written: {}, resolved: {}, opened: new Set(),

  begin(keywords) { this.keywords = new Map(keywords.map((word) => [word.key, word])); },

  /** The keyword of a key: gauges[0].at is described by gauges[].at. */
  word(key) { return this.keywords.get(key.replace(/\[\d+\]/g, "[]")) || this.keywords.get(key.replace(/\[\d+\]$/, "").replace(/\[\d+\]/g, "[]")); },
  /** A key in the words of the fields: mass, velocity y, gauges[0] at x. */
  title(key) {
    const [, path, k] = key.match(/^(.*)\[(\d+)\]$/) || [], item = path && this.keywords.has(path.replace(/\[\d+\]/g, "[]")), own = item ? path : key, group = this.group(own);
    return `${["scene", "body"].includes(group) ? "" : `${group} `}${own.slice(own.lastIndexOf(".") + 1)}${item ? ` ${"xyz"[k] ?? +k + 1}` : ""}`;
  },
  /** A message in these words. */
  words(text) {
    return text.replace(/\b[a-z_]+(\[\d*\])?(\.[a-z_]+(\[\d*\])*)+/g, (key) => (this.word(key) ? this.title(key) : key)).replace(/`([^`]*)`/g, "$1").replace(/"?\b(wcsph|boundary_element|von_karman|mlm)\b"?/g, (_, model) => TITLES[model]);
  },
  /** The table of a key: body.panels[0] of body.panels[0].name. */
  group(key) { return key.includes(".") ? key.slice(0, key.lastIndexOf(".")) : "scene"; },

  /** Show the keys that are written; an error stands at its key. */
  show(view) {
    this.written = view.written || this.written; this.resolved = view.resolved || this.resolved;
    const error = view.error, keys = Object.keys(this.written); let at = error?.key;
    // an error of an item belongs to the nearest key above it
    while (at && !keys.includes(at) && !this.word(at)) at = /[.[]/.test(at) ? at.replace(/(\[\d*\]|[.[][^.[]*)$/, "") : null;
    if (at && /\[\d+\]$/.test(at) && !keys.includes(at)) at = at.replace(/\[\d+\]$/, "");
    if (at && !keys.includes(at) && this.word(at)) keys.push(at); const groups = Map.groupBy(keys, (key) => this.group(key));
    if (!groups.has("body") && !groups.has("bodies[0]")) groups.set("body", []); const order = JSON.stringify([...groups]);
    if (order !== this.order) this.arrange(groups); this.order = order;
    for (const [key, field] of this.shown) field.update(this.written[key], key === at ? error : null);
    complain($("text"), "text_error", error ? `${error.line ? `Line ${error.line}: ` : ""}${error.message}` : "");
  },

  /** Lay out the groups; a field that stays is kept with its focus. */
  arrange(groups) {
    const focused = document.activeElement, old = this.shown; this.shown = new Map();
    const rank = (key) => [...this.keywords.keys()].indexOf(key.replace(/\[\d+\]/g, "[]"));
    const sets = [...groups].map(([name, keys]) => {
      const title = make("legend", {}, name);
      if (name.endsWith("]")) title.append(make("button", { type: "button", onclick: () => change([{ key: name, value: null }]) }, "Remove"));
      const set = make("fieldset", {}, title);
      for (const key of keys.sort((a, b) => rank(a) - rank(b))) {
        const field = old.get(key)?.usable ? old.get(key) : this.field(key, false); this.shown.set(key, field); set.append(field.node);
      }
      set.append(this.more(name, keys)); return set;
    });
    this.host.replaceChildren(...sets, this.adding()); if (focused?.isConnected) focused.focus({ preventScroll: true }); this.filter();
  },

  /** Keys of a table that the scene leaves to their defaults. */
  more(name, given) {
    const prefix = name === "scene" ? "" : `${name}.`, path = prefix.replace(/\[\d+\]/g, "[]");
    const fits = (word) => word.key.startsWith(path) && !word.key.slice(path.length).match(/[.[]/) && !given.includes(prefix + word.key.slice(path.length));
    const needed = (word) => !/^required by/.test(word.default) || word.default.includes(this.written[`${name}.shape`] || " ") || word.default.includes(this.written[`${name}.motion`] || "free");
    const words = [...this.keywords.values()].filter((word) => fits(word) && needed(word)); if (!words.length) return "";
    const details = make("details", {}, make("summary", {}, `${words.length} more keys of ${name}`)); details.open = this.opened.has(name);
    const fill = () => {
      if (details.open) this.opened.add(name); else this.opened.delete(name); if (!details.open || details.children.length > 1) return;
      for (const word of words) details.append(this.field(prefix + word.key.slice(path.length), true).node);
    };
    details.addEventListener("toggle", fill); details.fill = () => { details.open = true; fill(); }; fill(); return details;
  },

  /** Buttons for tables that can be added. */
  adding() {
    const lowest = () => (section.body ? section.body.points.reduce((a, b) => (b[1] < a[1] ? b : a)) : [0, 0]);
    const gauge = () => {
      const count = new Set(Object.keys(this.written).flatMap((key) => key.match(/^gauges\[\d+\]/) ?? [])).size, at = `gauges[${count}]`;
      change([{ key: `${at}.name`, value: `p${count + 1}` }, { key: `${at}.on`, value: "body" }, { key: `${at}.at`, value: `[${lowest().map(plain).join(", ")}]` }]);
    };
    const tables = [...new Set([...this.keywords.keys()].map((key) => key.split(".")[0]).filter((name) => !name.endsWith("[]")))];
    const missing = tables.filter((name) => [...this.keywords.keys()].some((key) => key.startsWith(`${name}.`)) && !Object.keys(this.written).some((key) => key.startsWith(`${name}.`)));
    const others = make("details", {}, make("summary", {}, "Other tables"), ...missing.filter((name) => name !== "body").map((name) => this.more(name, [])));
    return make("div", {}, make("div", { class: "tools" }, make("button", { type: "button", onclick: gauge }, "Add a gauge")), others);
  },

  /** Hide what does not have the words of the search. */
  filter() {
    const words = $("find").value.toLowerCase().split(/\s+/).filter(Boolean);
    if (words.length) this.host.querySelectorAll("details").forEach((details) => (details.fill ? details.fill() : (details.open = true)));
    this.host.querySelectorAll(".field").forEach((node) => { node.hidden = !words.every((word) => node.dataset.words.includes(word)); });
    this.host.querySelectorAll("fieldset, details").forEach((node) => { node.hidden = words.length > 0 && !node.querySelector(".field:not([hidden])"); });
  },

  field(key, absent) {
    const word = this.word(key) || { key, unit: "", default: "", doc: "", takes: "" };
    const name = key.slice(key.lastIndexOf(".") + 1), id = `f_${key.replace(/\W+/g, "_")}`;
    const inputs = make("div", { class: "inputs" }), error = make("div", { class: "error", role: "alert", id: `${id}_error` });
    const help = make("div", { hidden: true, id: `${id}_help` }, `${word.doc}${word.doc ? "; " : ""}${word.takes}${word.default ? ` (default: ${word.default})` : ""}`);
    const node = make("div", { class: "field", "data-key": key, "data-words": `${key} ${word.doc}`.toLowerCase() }, make("label", { for: `${id}_0` }, name, word.unit && word.unit !== "-" ? make("small", {}, ` [${word.unit}]`) : ""), inputs, help, error);
    const set = (value) => (key === "body.points" ? section.take(value) : change([{ key, value: String(value).trim() === "" ? null : value }]));
    const field = { node, name, kind: null, usable: !absent }; const described = { "aria-describedby": `${id}_error ${id}_help` };

    const build = (text, numbers) => {
      const only = (...nodes) => { inputs.replaceChildren(...nodes); field.inputs = nodes; }; only();
      const choices = word.takes === "true or false" ? ["true", "false"] : word.takes.includes(" | ") ? word.takes.split(" | ") : null;
      if (field.kind === "choice") {
        const select = make("select", { id: `${id}_0`, ...described, onchange: () => set(select.value) });
        if (absent) select.append(make("option", { value: "" }, `default: ${word.default}`));
        for (const choice of choices.includes(text) || absent ? choices : [text, ...choices]) select.append(make("option", { value: choice }, (key === "model" && TITLES[choice]) || choice));
        only(select);
      } else if (field.kind === "long") {
        const area = make("textarea", { id: `${id}_0`, rows: 3, spellcheck: "false", ...described, onchange: () => set(area.value) }); only(area);
      } else {
        (numbers || [null]).forEach((_, k) => {
          const label = numbers?.length > 1 ? this.title(`${key}[${k}]`) : null;
          const input = make("input", { type: "text", id: `${id}_${k}`, autocomplete: "off", spellcheck: "false", "aria-label": label, ...described });
          // TOML has no .5, and a part with a unit or a mistake is a string
          const part = (text) => (NUMBER.test(text.trim()) ? text.replace(/^\s*\+/, "").replace(/^(-?)\./, "$10.").replace(/\.(?!\d)/, "").replace(/^(-?)0+(?=\d)/, "$1") : text.trim() && JSON.stringify(text.trim()));
          const all = () => (field.inputs.length > 1 ? `[${field.inputs.map((own) => part(own.value)).join(", ")}]` : NUMBER.test(input.value.trim()) ? part(input.value) : input.value);
          let sent = null; const give = () => { if (all() !== sent) set((sent = all())); };
          input.addEventListener("input", () => { clearTimeout(input.later); input.later = setTimeout(give, 250); });
          input.addEventListener("change", () => { clearTimeout(input.later); give(); sent = null; });
          const one = make("div", { class: "one" }, numbers?.length > 1 ? make("small", {}, "xyz"[k] || "") : "", input);
          if (numbers) {
            const slider = make("input", { type: "range", "aria-label": `Slider of ${label || this.title(key)}`, tabindex: 0, step: "any" });
            slider.addEventListener("input", () => { input.value = plain(+slider.value); sent = all(); set(sent); });
            slider.addEventListener("change", () => { span(slider, +slider.value); sent = null; });
            slider.addEventListener("keydown", (event) => {
              const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key]; if (!by) return; event.preventDefault();
              slider.value = +slider.value + (by * (slider.max - slider.min)) / 100; slider.dispatchEvent(new Event("input"));
            });
            input.slider = slider; one.append(slider);
          }
          inputs.append(one); field.inputs.push(input);
        });
      }
      if (!absent && !/^required/.test(word.default)) inputs.append(make("button", { class: "remove", type: "button", title: `Remove ${this.title(key)}`, "aria-label": `Remove ${this.title(key)}`, onclick: () => change([{ key, value: null }]) }, "×"));
    };

    /** The range of a slider about a value, within what the key takes. */
    const span = (slider, value) => {
      const size = Math.abs(value) || 1, whole = word.takes.match(/from (-?[\d.]+) to (-?[\d.]+)/);
      let [low, high] = value === 0 ? [-1, 1] : value > 0 ? [0.4 * size, 1.8 * size] : [-1.8 * size, -0.4 * size];
      if (whole) [low, high] = [Math.max(low, +whole[1]), Math.min(high, +whole[2])]; slider.min = low; slider.max = high; slider.value = value;
    };

    field.update = (value, wrong) => {
      const text = value ?? "", own = parts(text), vector = /^\s*\[/.test(text) && /[^-]/.test(word.unit) && own.length > 1 && own.length < 4, numbers = vector ? own : numeric(text);
      const kind = word.takes.includes(" | ") || word.takes === "true or false" ? "choice" : key === "body.points" || /^\[\s*\[/.test(text) || text.length > 60 ? "long" : numbers ? `numbers${numbers.length}` : "text";
      if (kind !== field.kind && !(field.kind && inputs.contains(document.activeElement))) {
        field.kind = kind; node.classList.toggle("pair", /^numbers[23]/.test(kind));
        node.classList.toggle("long", kind === "long" || (kind === "text" && text.length > 14));
        build(text, kind.startsWith("numbers") ? numbers : null);
      }
      const values = field.kind.startsWith("numbers") && field.inputs.length > 1 ? numbers && own : [text];
      field.inputs.forEach((input, k) => {
        const own = values?.[k]; if (own !== undefined && !wrong?.keep && input !== document.activeElement && input.value !== own) input.value = own;
        if (absent && input.tagName === "INPUT") input.placeholder = fields.resolved[key] || word.default;
        if (input.slider) input.slider.hidden = !NUMBER.test(numbers?.[k]);
        if (input.slider && !input.slider.hidden && input.slider !== document.activeElement) span(input.slider, +numbers[k]);
        if (wrong) input.setAttribute("aria-invalid", "true"); else input.removeAttribute("aria-invalid");
      });
      const message = this.words(wrong ? (wrong.expected ? `Expected ${wrong.expected}${wrong.given ? `; given ${wrong.given}` : ""}.` : wrong.message) : "");
      if (error.textContent !== message) error.textContent = message;
    };
    field.update(absent ? undefined : this.written[key], null); return field;
  },
};

$("find").addEventListener("input", () => fields.filter());
fields.host.addEventListener("focusin", (event) => { $("help").textContent = fields.words(event.target.closest(".field")?.querySelector("[id$=_help]").textContent ?? ""); });
fields.host.addEventListener("focusout", () => { $("help").textContent = ""; });
