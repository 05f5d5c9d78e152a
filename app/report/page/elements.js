// SPDX-License-Identifier: Apache-2.0
// The data that stands in the page (report.h says what), and the pieces that the page is built from. What files say
// becomes text nodes, never HTML.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const colours = ["#3578d4", "#e07b30", "#229a6c", "#c4509c", "#8b6fd6", "#a98c12", "#2c9fb3", "#d24d4d"]; // legible on white and on black
const colourOf = run => colours[run % colours.length];

/// element("td.number", children...): text and elements; lists are taken apart, nothing is left out.
function element(kind, ...children) {
  const [tag, ...classes] = kind.split(".");
  const made = document.createElement(tag);
  if (classes.length) made.className = classes.join(" ");
  made.append(...children.flat(Infinity).filter(child => child !== null && child !== undefined));
  return made;
}

// ---- Numbers as people read them

function threeFigures(value) {
  if (typeof value !== "number") return "–";
  const text = value.toPrecision(3);
  return Math.abs(value) >= 1000 && Math.abs(value) < 1e9 ? Number(text).toFixed() : text;
}

function duration(seconds) {
  if (seconds < 0.1) return threeFigures(seconds * 1000) + " ms";
  if (seconds < 99.95) return threeFigures(seconds) + " s";
  const whole = Math.round(seconds), two = number => String(number).padStart(2, "0");
  if (whole < 3600) return `${Math.floor(whole / 60)} min ${two(whole % 60)} s`;
  return `${Math.floor(whole / 3600)} h ${two(Math.floor(whole % 3600 / 60))} min`;
}

const count = value =>
  value < 1e4 ? String(value) : value.toLocaleString("en", { notation: "compact", compactDisplay: "long", maximumSignificantDigits: 3 });
const bytes = value => value < 1048576 ? threeFigures(value / 1024) + " KiB" : threeFigures(value / 1048576) + " MiB";
/// A round value as it is, another one with three figures.
const level = value => String(Number(value.toPrecision(3)));
const exponent = value => value.toFixed(2).replace("-", "−");
const percent = (part, whole) => whole > 0 ? (100 * part / whole).toFixed(1) + " %" : "–";

/// The unit that a key of run.json ends with ("lost_w") goes from its name to its value.
const units = { _seconds: duration, _w: value => threeFigures(value) + " W", _mm: value => threeFigures(value) + " mm", _bytes: bytes };
const unitOf = key => Object.keys(units).find(unit => key.endsWith(unit)) ?? "";
const nameOf = key => key.slice(0, key.length - unitOf(key).length).replaceAll("_", " ");
const quantity = (key, value) => unitOf(key) ? units[unitOf(key)](value) : Number.isInteger(value) ? count(value) : threeFigures(value);

// ---- Pieces of the page

function dot(run) {
  const made = element("span.dot");
  made.style.setProperty("--run", colourOf(run));
  return made;
}
/// "1 first-light" with the run's colour before it; a line may end after a comma.
const runName = run => [dot(run), `${run + 1}\u00a0`, data.runs[run].label.split(/(?<=,)/).flatMap(part => [part, element("wbr")])];
const allNames = () => data.runs.map((_, run) => runName(run));
const number = (...text) => element("td.number", ...text);
const note = (...text) => element("p.note", ...text);
const tag = text => element("span.tag", text);

/// Cells are <td>, <th> or what goes into a <td>; a heading stands as its column does.
function table(headings, rows) {
  const cell = (content, kind) => content instanceof HTMLTableCellElement ? content : element(kind, content);
  const cells = rows.map(row => row.map(content => cell(content, "td")));
  const head = headings.map((heading, i) => element(cells[0]?.[i].className === "number" ? "th.number" : "th", heading));
  return element("div.table", element("table", headings.length ? element("thead", element("tr", head)) : null,
    element("tbody", cells.map(row => element("tr", row)))));
}

function section(id, title, ...content) {
  const made = element("section", element("h2", title), ...content);
  made.id = id;
  return made;
}
