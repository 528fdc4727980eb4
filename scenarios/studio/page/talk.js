/* Talking to the server, and small helpers. */
const token = new URLSearchParams(location.search).get("token") || "";
const $ = (id) => document.getElementById(id);

/** The JSON of an address; a body makes it a POST. */
async function ask(path, body, signal) {
  const method = body === undefined ? "GET" : "POST", sent = body instanceof Blob ? body : JSON.stringify(body);
  const response = await fetch(path, { method, headers: { "X-Splashdown-Token": token }, body: sent, signal });
  if (!response.ok) throw new Error((await response.text()).trim());
  return response.json();
}

/** An address that has the token. */
const address = (path) => `${path}${path.includes("?") ? "&" : "?"}token=${token}`;

/** An element with attributes and children. */
function make(tag, attributes = {}, ...children) {
  const svg = ["svg", "g", "path", "polygon", "polyline", "circle", "rect", "text", "line", "title"].includes(tag);
  const node = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value != null) node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child != null));
  return node;
}

const PREFIXED = ["N/m", "Pa", "N", "N s/m"];
/** The unit for numbers up to a size: its name and the factor from SI. */
function unitFor(si, size) {
  if (si === "s" && Math.abs(size) < 2) return { name: "ms", scale: 1e3 };
  if (PREFIXED.includes(si) && Math.abs(size) >= 1e6) return { name: `M${si}`, scale: 1e-6 };
  if (PREFIXED.includes(si) && Math.abs(size) >= 1e3) return { name: `k${si}`, scale: 1e-3 };
  return { name: si === "-" ? "" : si, scale: 1 };
}

/** A number with three digits. */
function digits(value) {
  if (!Number.isFinite(value)) return "–";
  const text = Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 1e-3) ? value.toExponential(2) : String(+value.toPrecision(3));
  return text.replace("-", "−");
}

/** A number with its unit. */
function withUnit(value, si) {
  const unit = unitFor(si, value);
  return `${digits(value * unit.scale)} ${unit.name}`.trim();
}

/** Seconds of waiting, roughly. */
const duration = (seconds) => (seconds < 90 ? `${Math.max(1, Math.round(seconds))} s` : seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${digits(seconds / 3600)} h`);

/** A number as a scene has it. */
const plain = (value) => String(+value.toPrecision(6));
