/* The scene of this page: its text, edits one after the other, and what follows from it. */
const pageId = crypto.randomUUID();
const scene = { text: "", file: "", written: {}, fingerprint: null, error: null, notice: "", lost: false, pending: [], busy: false, before: [] };

/** Change keys; edits of the same key that wait are one. A note is shown at the section until the next change. */
function change(edits, note = "") {
  $("section_note").textContent = note;
  for (const edit of edits) {
    scene.pending = scene.pending.filter((own) => own.key !== edit.key); scene.pending.push(edit);
  }
  return settle();
}

/** Another text, and the name of its file. */
function replace(text, file = scene.file) {
  scene.pending = []; scene.next = { text, file }; return change([]);
}

/** Something that was not done, until the next change. */
function notice(text) {
  scene.notice = text; answers.show();
}

/** Whether the server was reached; what waits is handed over once it is reached again. */
function reached(now) {
  if (scene.lost !== now) return; scene.lost = !now; answers.show(); if (now) settle();
}

/** Hand what waits to the server, and show what it says. */
async function settle() {
  if (scene.busy) return; scene.busy = true; let [next, edits] = [];
  try {
    while (scene.pending.length || scene.next) {
      [next, edits, scene.next, scene.pending] = [scene.next, scene.pending, null, []];
      const { text, file } = next ?? scene, view = await ask("/api/scene", { text, edits }); if (view.text !== scene.text) remember();
      Object.assign(scene, { text: view.text, file, written: view.written || scene.written, error: view.error }); keep();
      if (document.activeElement !== $("text")) $("text").value = scene.text; if (!scene.pending.length && !scene.next) show(view);
    }
  } catch (error) {
    if (scene.lost && !scene.next) [scene.next, scene.pending] = [next, [...edits, ...scene.pending]]; if (!scene.lost) notice(error.message);
  }
  scene.busy = false;
}

/** Keep the text for Undo; changes within a second are one. */
function remember() {
  const now = Date.now(), { text, file } = scene;
  if (text && now - (scene.kept || 0) > 1000) scene.before = [...scene.before.slice(-99), { text, file }]; scene.kept = now;
}
/** Keep the scene and the last texts before it for a reload. */
function keep() {
  $("undo").disabled = !scene.before.length; const { text, file, before } = scene;
  // a browser keeps some megabytes
  for (const count of [20, 1, 0]) try { return sessionStorage.setItem("scene", JSON.stringify({ text, file, before: before.slice(before.length - count) })); } catch { continue; }
}

function show(view) {
  scene.notice = $("run_error").textContent = ""; fields.show(view);
  if (view.section) {
    Object.assign(scene, { fingerprint: view.fingerprint, implausible: view.implausible, warnings: view.warnings }); section.show(view.section);
    grid.show(scene.written);
    $("cost").textContent = view.cost ? `${view.cost.fluid} particles, about ${duration(view.cost.core_seconds)} on one core` : "";
    answers.ask(scene.text); runs.match();
  } else {
    answers.show();
  }
}

async function begin() {
  const start = await ask("/api/start"); fields.begin(start.keywords); grid.begin();
  $("examples").append(...start.examples.map(({ name }, k) => make("option", { value: k }, name)));
  $("examples").addEventListener("change", () => {
    const example = start.examples[$("examples").value]; if (!example) return; replace(example.text, `${example.name.replace("new ", "")}.toml`);
    $("examples").value = "";
  });
  const kept = JSON.parse(sessionStorage.getItem("scene") || "null"); scene.before = kept?.before ?? [];
  await replace(kept?.text ?? start.text, kept?.file ?? start.file); runs.look();
}

$("text").addEventListener("input", () => { clearTimeout(scene.typing); scene.typing = setTimeout(() => replace($("text").value), 250); });
$("open").addEventListener("change", async (event) => {
  const [file] = event.target.files; event.target.value = ""; if (!file) return;
  if (file.size > 9e5) return notice(`${file.name} was not opened: expected a scene below 0.9 MB.`); replace(await file.text(), file.name);
});
$("download").addEventListener("click", () => {
  const link = make("a", { href: URL.createObjectURL(new Blob([scene.text], { type: "application/toml" })), download: scene.file || "scene.toml" });
  link.click(); URL.revokeObjectURL(link.href);
});
$("undo").addEventListener("click", () => {
  const { text, file } = scene.before.pop() ?? {}; scene.kept = Infinity; if (text !== undefined) replace(text, file).then(() => { scene.kept = 0; });
});
document.addEventListener("keydown", (event) => {
  // a box for text has an Undo of its own
  if (event.key !== "z" || event.shiftKey || !(event.ctrlKey || event.metaKey) || event.target.matches("textarea, input:not([type=range], [type=checkbox], [type=file])")) return;
  event.preventDefault(); $("undo").click();
});

window.addEventListener("resize", () => {
  clearTimeout(scene.resized); scene.resized = setTimeout(() => { answers.tallest = 0; section.draw(); answers.show(); grid.draw(); }, 150);
});

begin().catch((error) => notice(error.message));
