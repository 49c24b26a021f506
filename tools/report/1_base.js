// What the parts of the page share: the data, elements, numbers, colours.
"use strict";

const DOCUMENTS = JSON.parse(document.getElementById("results").textContent);
const PICTURES = JSON.parse(document.getElementById("pictures").textContent);

// Okabe and Ito's colours, told apart by all eyes; the two first swapped for contrast on white.
const PALETTE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6bb1", "#7f7f7f"];
const PASS_PALETTE = ["#4477aa", "#66ccee", "#228833", "#ccbb44", "#ee6677", "#aa3377", "#bbbbbb", "#997700", "#44aa99",
  "#882255", "#6699cc", "#dddd77"];

// element("td", {class: "x"}, child, "text", ...)
function element(tag, attributes, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) node.setAttribute(name, value);
  for (const child of children) if (child !== null) node.append(child);
  return node;
}

// Three significant digits, without exponents where a person needs none.
function formatNumber(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(1).replace("e+", "e").replace("-", "−");
  const digits = Math.max(0, 2 - Math.floor(Math.log10(size)));
  return value.toFixed(digits).replace("-", "−");
}

function formatMs(value) {
  return value === null ? "–" : value >= 100 ? value.toFixed(0) : value.toFixed(1);
}

function colourOf(index) {
  return PALETTE[index % PALETTE.length];
}

function styleOf(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

// A table in a box that scrolls by itself. Rows are {cells: [text or node], group: starts a group}.
function makeTable(headings, rows) {
  const head = element("tr", {}, ...headings.map((heading) => element("th", {}, heading)));
  const body = rows.map((row) => element("tr", row.group ? {class: "group"} : {},
    ...row.cells.map((cell) => element("td", {}, cell))));
  return element("div", {class: "scroll"},
    element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)));
}

// Whether the middle of a 95 % interval is off `value` by more than twice the interval's reach. A page has dozens of
// intervals: one in twenty misses by chance, one in ten thousand by so much.
function isFarFrom(value, low, high) {
  return Math.abs((low + high) / 2 - value) > high - low;
}

// mean +- half of the interval; marked where `isOdd`.
function makeEstimate(estimate, isOdd) {
  const reach = (estimate.high - estimate.low) / 2;
  return element("span", isOdd ? {class: "mark"} : {}, formatNumber(estimate.mean),
    element("span", {class: "pm"}, " ± " + formatNumber(reach)));
}

function swatch(index) {
  return element("span", {class: "swatch", style: "background:" + colourOf(index)});
}
