/* Talking to the server, and small helpers. */
const token = new URLSearchParams(location.search).get("token") || "";
const $ = (id) => document.getElementById(id);

/** The JSON of an address; a body makes it a POST. */
async function ask(path, body, signal) {
  const method = body === undefined ? "GET" : "POST", sent = body instanceof Blob ? body : JSON.stringify(body);
  const response = await fetch(path, { method, headers: { "X-Splashdown-Token": token }, body: sent, signal }).catch((error) => {
    if (error.name !== "AbortError") reached(false); throw error;
  });
  reached(true); if (!response.ok) throw new Error((await response.text()).trim()); return response.json();
}

/** An address that has the token. */
const address = (path) => `${path}${path.includes("?") ? "&" : "?"}token=${token}`;

/** An element with attributes and children. */
function make(tag, attributes = {}, ...children) {
  const svg = ["svg", "g", "path", "polygon", "polyline", "circle", "rect", "text", "line", "title"].includes(tag);
  const node = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value); else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value != null) node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child != null)); return node;
}

const PREFIXED = ["N/m", "Pa", "N", "N s/m"];
/** The unit for numbers up to a size: its name and the factor from SI. */
function unitFor(si, size) {
  if (si === "s" && Math.abs(size) < 2) return { name: "ms", scale: 1e3 };
  if (PREFIXED.includes(si) && Math.abs(size) >= 1e6) return { name: `M${si}`, scale: 1e-6 };
  if (PREFIXED.includes(si) && Math.abs(size) >= 1e3) return { name: `k${si}`, scale: 1e-3 }; return { name: si === "-" ? "" : si, scale: 1 };
}

/** A number with three digits. */
function digits(value) {
  if (!Number.isFinite(value)) return "–";
  const text = Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 1e-3) ? value.toExponential(2) : String(+value.toPrecision(3));
  return text.replace("-", "−");
}

/** A number with its unit. */
function withUnit(value, si) {
  const unit = unitFor(si, value); return `${digits(value * unit.scale)} ${unit.name}`.trim();
}

/** Seconds of waiting, roughly. */
const duration = (seconds) => (seconds < 90 ? `${Math.max(1, Math.round(seconds))} s` : seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${digits(seconds / 3600)} h`);

/** A number of the page's own as a scene has it. */
const plain = (value) => String(+value.toPrecision(6));

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i, LENGTHS = { "": 1, m: 1, cm: 1e-2, mm: 1e-3, km: 1e3, in: 0.0254, ft: 0.3048 };
/** A length that was typed, in m; NaN for another text. */
function length(text) {
  const [, number, unit] = text.trim().match(/^(.*?)\s*([a-z]*)$/i);
  return NUMBER.test(number) && unit in LENGTHS ? +(number * LENGTHS[unit]).toPrecision(15) : NaN;
}
/** The parts of a value without quotes, of a list its items. */
function parts(text) {
  const list = text.trim().match(/^\[([^[\]]*)\]$/);
  return (list ? list[1].match(/"[^"]*"|[^,\s][^,]*/g) || [] : [text]).map((part) => part.trim().replace(/^"(.*)"$/, "$1"));
}
/** The numbers of a value that has only such, up to three of them. */
function numeric(text) {
  const all = parts(text).map((part) => part.replace(/_/g, ""));
  return all.length && all.length <= 3 && all.every((part) => NUMBER.test(part)) ? all.map(Number) : null;
}
/** A message at a control, which is marked; without one the mark goes. */
function complain(control, at, message) {
  $(at).textContent = message; if (message) control.setAttribute("aria-invalid", "true"); else control.removeAttribute("aria-invalid");
}
/** Whether a box is wider than its place, to be said there. */
const markWide = (box) => box.toggleAttribute("data-wide", box.scrollWidth > box.clientWidth + 1);
const TITLES = { von_karman: "von Kármán", wagner: "Wagner", mlm: "modified Logvinovich", similarity: "similarity solution", boundary_element: "boundary elements", wcsph: "particles", incompressible: "incompressible particles" };
