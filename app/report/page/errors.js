// SPDX-License-Identifier: Apache-2.0
// "Error against time": for each metric its chart, the time to reach round errors, and speed-ups at equal error.
"use strict";

/// The numbers of a logarithmic axis: powers of ten over three decades and more, else with 2 and 5 between, within a part of a decade
/// multiples of a round step.
function ticks(low, high) {
  const levels = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power)
    for (const digit of high / low >= 1000 ? [1] : [1, 2, 5]) levels.push(Number(`${digit}e${power}`));
  const within = levels.filter(level => level >= low && level <= high);
  if (within.length > 12) return within.filter((_, i) => i % Math.ceil(within.length / 12) === 0);
  if (within.length >= 3) return within;
  const span = high - low, power = 10 ** Math.floor(Math.log10(span / 3));
  const step = [1, 2, 5, 10].find(digit => span / (digit * power) < 7) * power;
  return Array.from({ length: 8 }, (_, i) => Number(((Math.ceil(low / step) + i) * step).toPrecision(6))).filter(level => level <= high);
}

const lineName = (metric, line) => `${line.run + 1} ${data.runs[line.run].label}${line.estimate ? " (estimate)" : ""}` +
  (line.slope !== null ? `, slope ${exponent(line.slope)}` : "");

/// The curves; a run's estimate goes without a name where its error is drawn as well.
function curveSets(metric) {
  const hasError = run => metric.lines.some(line => line.run === run && !line.estimate);
  return metric.lines.map(line => ({
    label: line.estimate && hasError(line.run) ? "" : lineName(metric, line), run: line.run,
    data: line.points.map(([x, y]) => ({ x, y })), borderColor: colourOf(line.run), backgroundColor: colourOf(line.run),
    borderWidth: line.estimate ? 1.4 : 2, borderDash: line.estimate ? [5, 4] : [], pointRadius: line.estimate ? 1 : 2,
  }));
}

/// The noise floors, and a slope to compare with, just below everything, where it hides nothing.
function guideSets(metric, points, floors, [left, right], colour) {
  const straight = (label, from, to, borderDash) => ({ label, data: [{ x: left, y: from }, { x: right, y: to }], borderDash,
    borderColor: colour, borderWidth: 1.2, pointRadius: 0, pointHitRadius: 0 });
  const sets = floors.map((floor, i) => straight(i === 0 ? "noise floor of the reference" : "", floor, floor, [8, 6]));
  if (!metric.falls || metric.law === null) return sets;
  const factor = .75 * points.reduce((least, [seconds, error]) => Math.min(least, error / seconds ** metric.law), Infinity);
  return [...sets, straight(`slope ${exponent(metric.law)}`, factor * left ** metric.law, factor * right ** metric.law, [2, 4])];
}

function chart(canvas, metric) {
  const style = getComputedStyle(document.documentElement), ink = style.getPropertyValue("--ink"), rule = style.getPropertyValue("--rule");
  const points = metric.lines.flatMap(line => line.points);
  const floors = [...new Set(metric.lines.map(line => line.floor).filter(floor => floor > 0))];
  const ends = (values, room) =>
    values.reduce(([low, high], value) => [Math.min(low, value / room), Math.max(high, value * room)], [Infinity, 0]);
  const [left, right] = ends(points.map(([seconds]) => seconds), 1.15);
  const [bottom, top] = ends([...points.map(([, error]) => error), ...floors], 1.4);
  const datasets = [...curveSets(metric), ...guideSets(metric, points, floors, [left, right], ink)];

  const axis = (title, isLogarithmic, range) => ({
    type: isLogarithmic ? "logarithmic" : "linear", ...range, title: { display: true, text: title, color: ink },
    grid: { color: rule, borderColor: ink }, ticks: { color: ink, callback: value => String(Number(value.toPrecision(6))) },
    afterBuildTicks: scale => { if (isLogarithmic) scale.ticks = ticks(scale.min, scale.max).map(value => ({ value })); },
  });
  const hide = (_, { datasetIndex }, { chart: drawn }) => { // a run's estimate goes with its error
    const { run } = datasets[datasetIndex], isVisible = !drawn.isDatasetVisible(datasetIndex);
    datasets.forEach((other, i) => {
      if (i === datasetIndex || (run !== undefined && other.run === run)) drawn.setDatasetVisibility(i, isVisible);
    });
    drawn.update();
  };
  const dashed = drawn => Chart.defaults.plugins.legend.labels.generateLabels(drawn).map(item =>
    ({ ...item, lineWidth: datasets[item.datasetIndex].borderWidth, lineDash: datasets[item.datasetIndex].borderDash }));
  const hover = ({ dataset, parsed }) => `${data.runs[dataset.run].label}${dataset.borderDash.length ? " (estimate)" : ""}: ` +
    `${threeFigures(parsed.y)} ${metric.over ? `at ${metric.over} ${threeFigures(parsed.x)}` : `after ${duration(parsed.x)}`}`;
  return new Chart(canvas, { type: "scatter", data: { datasets }, options: {
    animation: false, maintainAspectRatio: false, showLine: true, interaction: { mode: "nearest", intersect: false },
    scales: {
      x: metric.over ? axis(metric.over, false, {}) : axis("work (s)", true, { min: left, max: right }),
      y: axis(metric.label + (metric.unit && ` (${metric.unit})`), metric.falls, metric.falls ? { min: bottom, max: top } : { grace: "5%" }),
    },
    plugins: {
      legend: { position: "bottom", align: "start", onClick: hide, labels: { color: ink, usePointStyle: true, pointStyle: "line",
        pointStyleWidth: 30, generateLabels: dashed, filter: item => item.text } },
      tooltip: { filter: item => item.dataset.run !== undefined, callbacks: { label: hover } },
    },
  } });
}

function caption(metric) {
  if (!metric.falls) return metric.larger_is_better ? "Larger is better." : "";
  const floors = metric.lines.some(line => line.floor > 0);
  return [metric.lines.some(line => line.estimate) ? "Dashed: a run's own estimate of its error; solid: its distance to its reference. " : "",
    floors ? "Horizontal: what the reference itself is off by, below which a distance to it says nothing. " : "",
    metric.lines.some(line => line.slope !== null) ? "Slopes are least-squares fits in log-log, equal parts of the time axis counting equally" +
      (floors ? `, over errors of at least ${metric.law === -1 ? 9 : 3} times the floor. ` : ". ") : "",
    metric.law !== null ? `Independent samples give ${exponent(metric.law)}. ` : "",
    "Click a name to hide its curve."].join("");
}

function timesTable(metric) {
  const cell = of => of === null ? number("–") : number(of.earlier ? "< " : "", duration(of.seconds), of.near_floor ? " *" : "");
  const slopeOf = run => metric.lines.find(line => line.run === run && line.slope !== null)?.slope;
  const rows = metric.times.map(({ run, estimate, cells }) => [element("th", runName(run), " ", estimate ? tag("estimate") : null),
    number(slopeOf(run) === undefined ? "–" : exponent(slopeOf(run))), ...cells.map(cell)]);
  const anyNearFloor = metric.times.some(({ cells }) => cells.some(of => of?.near_floor));
  return [element("h3", "Time to reach an error"), table([metric.unit || "error", "slope", ...metric.levels.map(level)], rows),
    note("Work until the error first fell so far, between measurements along a straight line in log-log; <: it was there at its first " +
      "measurement; –: never.", anyNearFloor ? " *: near the reference's own noise floor." : "")];
}

function speedUps(metric) {
  const anyRemark = metric.pairs.some(pair => pair.remark);
  const rows = metric.pairs.map(pair => [element("td", runName(pair.faster)), element("td", runName(pair.slower)),
    number(level(pair.error), pair.estimate ? [" ", tag("estimate")] : null), number(duration(pair.faster_seconds)),
    number(duration(pair.slower_seconds)), number(element("strong", threeFigures(pair.speed_up) + " ×")),
    ...(anyRemark ? [element("td.warn", pair.remark)] : [])]);
  const headings = ["faster", "slower", `at the error${metric.unit && ` (${metric.unit})`}`, "faster takes", "slower takes", "speed-up",
    ...(anyRemark ? ["to be read with care"] : [])];
  const care = "Times are those of each run's own file: compare runs of one machine, made in one go.";
  return [data.runs.length > 1 ? element("h3", "Speed-up at equal error") : null, ...(rows.length ? [table(headings, rows), note(care)] : []),
    metric.not_compared.length ? note(`Not compared: ${metric.not_compared.join("; ")}.`) : null];
}

function metricPanel(metric) {
  const biased = metric.biased.length ? note(element("span.warn", "Biased:"), metric.biased.map(run => [" ", runName(run)]),
    ". At the end the distance to the reference is more than twice what noise explains: a systematic difference, which more work does not " +
    "remove.") : null;
  return [element("figure.chart", element("div", element("canvas")), element("figcaption", caption(metric))), biased,
    ...(metric.falls ? [...timesTable(metric), ...speedUps(metric)] : [])];
}

/// The curves that engines add, as metrics that are no errors: one for each column but the first, which they are drawn over.
function engineCurves() {
  const lineOf = (run, rows, i) => ({ run, estimate: false, slope: null, floor: 0,
    points: rows.map(row => [row[0], row[i]]).filter(point => !point.includes(null)) });
  const all = data.runs.flatMap(({ curves }, run) => curves.flatMap(({ name, columns, rows }) => columns.slice(1).map((column, i) =>
    ({ label: `${name}: ${column}`, over: columns[0], line: lineOf(run, rows, i + 1) })))).filter(({ line }) => line.points.length);
  return [...new Set(all.map(({ label }) => label))].map(label => ({ label, unit: "", law: null, falls: false, biased: [],
    over: all.find(other => other.label === label).over, lines: all.filter(other => other.label === label).map(({ line }) => line) }));
}

function errorsSection() {
  const metrics = [...data.metrics, ...engineCurves()];
  const panel = element("div"), tabs = element("div.buttons");
  let drawn = null, shown = 0;
  const show = index => {
    shown = index;
    drawn?.destroy();
    panel.replaceChildren(...metricPanel(metrics[index]).filter(part => part));
    const canvas = panel.querySelector("canvas");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${metrics[index].label} against ${metrics[index].over ?? "seconds of work"}`);
    drawn = chart(canvas, metrics[index]);
    [...tabs.children].forEach((tab, i) => tab.setAttribute("aria-pressed", i === index));
  };
  metrics.forEach((metric, i) => {
    tabs.append(element("button", metric.label));
    tabs.lastChild.addEventListener("click", () => show(i));
  });
  const missing = data.runs.map(({ measurements }, run) => measurements ? null : note(runName(run), measurements === null
    ? ": has no history.csv: it did not measure its error." : ": its history.csv has no row: it ended before its first measurement."));
  const content = metrics.length ? [tabs, panel] : [element("p", "Nothing to draw: no run has an error above 0 in its history.")];
  if (metrics.length) addEventListener("load", () => show(0)); // a canvas takes the size that it has on the page
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { if (drawn) show(shown); });
  return section("errors", "Error against time", ...content, ...missing);
}
