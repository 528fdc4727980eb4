/* Runs: begun, watched, stopped, shown, compared. */
const runs = {
  ticked: new Set(), nodes: new Map(), texts: JSON.parse(sessionStorage.getItem("runs") || "{}"), known: new Set(), timer: null,

  async start() {
    const model = $("run_model").value; $("run_error").textContent = "";
    try {
      let text = scene.text;
      if (model) {
        const edits = ["solver", "want", "within"].map((key) => ({ key, value: null }));
        text = (await ask("/api/scene", { text, edits: [...edits, { key: "model", value: model }] })).text;
      }
      const { name, error } = await ask("/api/runs", { text });
      if (error) { $("run_error").textContent = fields.words(error.message); return; }
      this.texts[name] = scene.text; sessionStorage.setItem("runs", JSON.stringify(this.texts)); this.look();
    } catch (error) {
      $("run_error").textContent = error.message;
    }
  },

  /** Look at the list; soon again while something goes on. */
  async look() {
    clearTimeout(this.timer); let busy = false;
    try {
      const list = await ask("/api/runs"); busy = list.some((run) => run.state !== "ended"); this.show(list); this.list = list; await this.match();
    } catch (error) {
      if (!scene.lost) $("run_error").textContent = error.message;
    }
    this.timer = setTimeout(() => this.look(), busy ? 400 : 4000);
  },

  /** Answers of runs of the present scene join those of the theories; others leave. */
  async match() {
    for (const run of this.list || []) {
      const key = `run ${run.name}`, fits = run.state === "ended" && run.has_results && (this.texts[run.name] === scene.text || run.fingerprint === scene.fingerprint);
      if (!fits) answers.forget(key); else if (!answers.all.has(key)) answers.add(key, await ask(`/api/runs/${run.name}/answer`));
    }
  },

  show(list) {
    const kept = new Set(list.map((run) => run.name));
    for (const [name, node] of this.nodes) if (!kept.has(name)) { node.remove(); this.nodes.delete(name); }
    list.forEach((run, k) => {
      let node = this.nodes.get(run.name);
      if (!node || node.state !== run.state) {
        const fresh = this.line(run); if (node) node.replaceWith(fresh); else $("runs").insertBefore(fresh, $("runs").children[k] || null);
        this.nodes.set(run.name, (node = fresh));
      }
      node.update?.(run);
    });
    $("compare").disabled = this.ticked.size < 2;
  },

  line(run) {
    const node = make("li", {}), line = make("div", { class: "line" }); node.state = run.state; node.dataset.run = run.name; node.append(line);
    if (run.state === "ended") {
      const box = make("input", { type: "checkbox", "aria-label": `Compare ${run.name}`, disabled: !run.has_results, onchange: () => { this.ticked[box.checked ? "add" : "delete"](run.name); $("compare").disabled = this.ticked.size < 2; } });
      box.checked = this.ticked.has(run.name);
      line.append(box, make("b", {}, run.name), make("span", {}, `${run.model}: ${run.words}`));
      if (run.report) line.append(make("button", { onclick: () => this.frame(`Report of ${run.name}`, `/runs/${run.name}/report.html`) }, "Report"));
      node.append(make("div", { class: "hint" }, [run.has_results && run.peak, run.inputs].filter(Boolean).join("; ")));
      if (run.message) node.append(make("p", { class: "error" }, fields.words(run.message))); return node;
    }
    const bar = make("progress", { max: 1, "aria-label": `Progress of ${run.name}` }), words = make("span", { class: "hint" });
    const stop = make("button", { onclick: async () => { stop.disabled = true; await ask(`/api/runs/${run.name}/stop`, {}); this.look(); } }, "Stop");
    line.append(make("b", {}, run.name), make("span", {}, `${run.model}: ${run.words}; ${run.inputs}`), bar, words, stop);
    const picture = make("img", { alt: `Pressure in the water, run ${run.name}`, hidden: true, onload: () => { picture.hidden = false; } });
    node.append(picture);
    node.update = (now) => {
      bar.value = now.share || 0; const left = now.remaining == null ? "" : `, about ${duration(now.remaining)} to go`;
      words.textContent = now.state === "running" ? `${Math.round(100 * (now.share || 0))} %, ${digits(1e3 * now.time)} of ${digits(1e3 * now.end)} ms${left}` : "waits for the run before it";
      if (now.state !== "running" || !now.particles || !picture.complete) return;
      // an empty answer before the first frame, an error to the page
      picture.src = address(`/api/runs/${run.name}/picture?at=${now.time}`);
    };
    return node;
  },

  frame(title, path) {
    $("shown").hidden = false; $("shown_title").textContent = title; $("shown_tab").href = $("frame").src = address(path); $("frame").title = title;
    $("shown").scrollIntoView({ block: "nearest" });
  },
};

$("run").addEventListener("click", () => runs.start());
$("compare").addEventListener("click", () => runs.frame("Comparison", `/api/compare?${[...runs.ticked].map((name) => `run=${encodeURIComponent(name)}`).join("&")}`));
$("shown_close").addEventListener("click", () => { $("shown").hidden = true; $("frame").removeAttribute("src"); });
