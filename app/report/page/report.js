// SPDX-License-Identifier: Apache-2.0
// "What was compared", "Plans" and "Machines", and the page out of all sections.
"use strict";

function runsTable() {
  const wanted = data.runs.flatMap(({ run }) => Object.keys(run).filter(key => typeof run[key] === "number"));
  const keys = [...new Set(wanted)].filter(key => key !== "seed" && key !== "fraction");
  const cell = ({ run }, key) => number(run[key] === undefined ? "–" : quantity(key, run[key]),
    key === "measuring_seconds" && run[key] !== undefined ? ` (${percent(run[key], run.work_seconds + run[key])})` : null);
  const headings = ["run", ...keys.map(nameOf), "device", "folder"];
  const rows = data.runs.map((of, run) => [element("th", runName(run)), ...keys.map(key => cell(of, key)),
    String(of.run.device.name ?? "–"), element("code", of.folder)]);
  return [table(headings, rows),
    note("Work is the time of rendering alone, without start-up and without measuring; errors are drawn over it. The share is that of " +
      "measuring in the two together.")];
}

function settingsTable() {
  if (data.runs.length < 2) return [];
  const keys = [...new Set(data.runs.flatMap(run => Object.keys(run.settings)))].sort().filter(key =>
    key !== "name" && key !== "description" && new Set(data.runs.map(run => run.settings[key])).size > 1);
  const value = text => text === undefined ? "–" : element("code", text.length > 60 ? text.slice(0, 60) + "…" : text);
  const rows = keys.map(key => [element("th", element("code", key)), ...data.runs.map(run => value(run.settings[key]))]);
  return [element("h3", "Settings that differ"),
    rows.length ? table(["setting", ...allNames()], rows) : element("p", "None: the presets of all runs are the same.")];
}

function errorsTable() {
  const cell = ({ run }, column) => {
    const floor = run.reference?.noise_floor?.[column];
    return number(threeFigures(run.errors?.[column]), floor === undefined ? null : element("small", `floor ${threeFigures(floor)}`));
  };
  const rows = ["", "estimated_"].flatMap(prefix => data.metrics
    .filter(({ metric }) => data.runs.some(({ run }) => run.errors && prefix + metric in run.errors))
    .map(({ metric, label, unit }) => [element("th", label, " ", element("small", unit), " ", prefix ? tag("estimate") : null),
      ...data.runs.map(run => cell(run, prefix + metric))]));
  return rows.length ? [element("h3", "Errors at the end"), table(["metric", ...allNames()], rows),
    note("Floor: what the reference itself is off by. An estimate is a run's own, made from two independent halves of its samples.")] : [];
}

/// The same details for every run, folded away where there are several.
const forEachRun = details => data.runs.map(({ run, plan }, i) => {
  const made = element("details", element("summary", runName(i)), details(run, plan));
  made.open = data.runs.length === 1;
  return made;
});

function planOf(run, { passes, buffers, notes }) {
  const rows = passes.map(pass => [element("th", pass.name), pass.runs ? "runs" : tag("left out"), pass.reason]);
  const total = buffers.reduce((sum, buffer) => sum + buffer.bytes, 0);
  return [table(["pass", "", "reason"], rows), note(`Buffers: ${buffers.length}, ${bytes(total)}.`),
    ...(Array.isArray(notes) ? notes : []).map(text => note(String(text)))];
}

/// Any value of run.json: what an engine adds is shown as it stands. Shares are those of the power emitted, of times those of the work.
function facts(value, key, run) {
  if (typeof value === "number") return quantity(key, value);
  if (typeof value !== "object" || value === null) return String(value ?? "–");
  const isSeconds = key.endsWith("_seconds"), whole = isSeconds ? run.work_seconds : value.emitted_w;
  return table([], Object.entries(value).map(([name, part]) => {
    const full = isSeconds ? name + "_seconds" : name, hasShare = typeof part === "number" && whole > 0 && unitOf(full) !== "";
    const cell = element(typeof part === "number" ? "td.number" : "td", facts(part, full, run));
    return [element("th", nameOf(full)), cell, ...(hasShare ? [number(percent(part, whole))] : [])];
  }));
}

function machineOf(run) {
  const elsewhere = ["name", "finished", "notes", "errors", "error_column"]; // as the numbers are, but for the seed
  const shown = Object.entries(run).filter(([key, value]) => key === "seed" || !(typeof value === "number" || elsewhere.includes(key)));
  return [table([], shown.map(([key, value]) => [element("th", nameOf(key)), facts(value, key, run)]))];
}

document.title = data.title + " - Nephroid";
const sections = [
  section("pictures", "Pictures", ...picturesSideBySide(), ...pictureViewers(), ...data.notes.map(text => note(text))),
  section("compared", "What was compared", ...runsTable(), ...settingsTable(), ...errorsTable()),
  errorsSection(),
  section("plans", "Plans", ...forEachRun(planOf)),
  section("machines", "Machines", ...forEachRun(machineOf)),
];
const links = sections.map(made => {
  const link = element("a", made.querySelector("h2").textContent);
  link.href = "#" + made.id;
  return link;
});
document.body.append(element("header", element("h1", data.title), element("nav", links)), element("main", sections));
