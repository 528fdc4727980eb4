/* The scene of this page: its text, edits one after the other, and what follows from it. */
const pageId = crypto.randomUUID();
const scene = { text: "", written: {}, fingerprint: null, error: null, pending: [], busy: false, before: [] };

/** Change keys; edits of the same key that wait are one. */
function change(edits) {
  for (const edit of edits) {
    scene.pending = scene.pending.filter((own) => own.key !== edit.key);
    scene.pending.push(edit);
  }
  return settle();
}

/** Another text. */
function replace(text) {
  scene.pending = [];
  scene.next = text;
  return settle();
}

/** Hand what waits to the server, and show what it says. */
async function settle() {
  if (scene.busy) return;
  scene.busy = true;
  try {
    while (scene.pending.length || scene.next !== undefined) {
      const text = scene.next ?? scene.text, edits = scene.pending;
      [scene.pending, scene.next] = [[], undefined];
      const view = await ask("/api/scene", { text, edits });
      if (view.text !== scene.text) remember();
      scene.text = view.text;
      Object.assign(scene, { written: view.written || scene.written, error: view.error });
      sessionStorage.setItem("text", scene.text);
      if (document.activeElement !== $("text")) $("text").value = scene.text;
      if (!scene.pending.length && scene.next === undefined) show(view);
    }
  } catch (error) {
    $("scene_error").textContent = `The studio does not answer: ${error.message}`;
  }
  scene.busy = false;
}

/** Keep the text for Undo; changes within a second are one. */
function remember() {
  const now = Date.now();
  if (scene.text && now - (scene.kept || 0) > 1000) scene.before = [...scene.before.slice(-99), scene.text];
  scene.kept = now;
  $("undo").disabled = !scene.before.length;
}

function show(view) {
  fields.show(view);
  if (view.section) {
    Object.assign(scene, { fingerprint: view.fingerprint, name: view.name });
    section.show(view.section);
    grid.show(scene.written);
    $("run_error").textContent = "";
    $("cost").textContent = view.cost ? `${view.cost.fluid} particles, about ${duration(view.cost.core_seconds)} on one core` : "";
    answers.ask(scene.text);
    runs.match();
  } else {
    answers.show();
  }
}

async function begin() {
  const start = await ask("/api/start");
  fields.begin(start.keywords);
  grid.begin();
  scene.file = start.file;
  $("examples").append(...start.examples.map(({ name }, k) => make("option", { value: k }, name)));
  $("examples").addEventListener("change", () => {
    const example = start.examples[$("examples").value];
    if (!example) return;
    scene.file = `${example.name.replace("new ", "")}.toml`;
    replace(example.text);
    $("examples").value = "";
  });
  await replace(sessionStorage.getItem("text") ?? start.text);
  runs.look();
}

$("text").addEventListener("input", () => { clearTimeout(scene.typing); scene.typing = setTimeout(() => replace($("text").value), 250); });
$("open").addEventListener("change", async (event) => {
  const [file] = event.target.files;
  event.target.value = "";
  if (!file) return;
  if (file.size > 9e5) { $("scene_error").textContent = `${file.name}: expected a scene below 0.9 MB`; return; }
  scene.file = file.name;
  replace(await file.text());
});
$("download").addEventListener("click", () => {
  const link = make("a", { href: URL.createObjectURL(new Blob([scene.text], { type: "application/toml" })), download: scene.file || "scene.toml" });
  link.click();
  URL.revokeObjectURL(link.href);
});
$("undo").addEventListener("click", () => {
  const text = scene.before.pop();
  scene.kept = Infinity;
  $("undo").disabled = !scene.before.length;
  if (text !== undefined) replace(text).then(() => { scene.kept = 0; });
});

window.addEventListener("resize", () => {
  clearTimeout(scene.resized);
  scene.resized = setTimeout(() => { section.draw(); answers.show(); grid.draw(); }, 150);
});

begin().catch((error) => { $("scene_error").textContent = error.message; });
