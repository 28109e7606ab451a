// Figures as text, and elements from text. Text from outside only ever becomes text nodes and attributes.

const missing = "–";

function grouped(digits) {
  return digits.replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f");
}

// Three significant digits, more where the whole part has more; no exponents.
function figure(value) {
  if (value === null || value === undefined) return missing;
  if (value === 0) return "0";
  const size = Math.abs(value);
  const decimals = Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(size))));
  const [whole, part] = value.toFixed(decimals).split(".");
  return grouped(whole) + (part ? "." + part : "");
}

const whole = (value) => grouped(String(Math.round(value)));
const fixed = (decimals) => (value) => (value === null ? missing : value.toFixed(decimals));
const percent = (value) => (100 * value).toFixed(2);

// For axes: 12000 -> 12k.
function short(value) {
  const units = ["", "k", "M", "G", "T"];
  let unit = 0;
  while (Math.abs(value) >= 999.5 && unit + 1 < units.length) {
    value /= 1000;
    ++unit;
  }
  return `${Number(value.toPrecision(3))}${units[unit]}`;
}
// Of 1000, as the sizes of disks.
const bytes = (value) => short(value).replace(/(\D?)$/, " $1B");

const svgSpace = "http://www.w3.org/2000/svg";

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}

// element("a", {href: "x", onclick: f}, "text", otherNode)
const element = (name, attributes, ...children) => fill(document.createElement(name), attributes, children);
const shape = (name, attributes, ...children) => fill(document.createElementNS(svgSpace, name), attributes, children);
const byId = (id) => document.getElementById(id);

function select(choices, chosen, onChange) {
  const node = element("select", { onchange: () => onChange(node.value) });
  for (const [value, text] of choices) node.append(element("option", { value, selected: value === chosen }, text));
  return node;
}
