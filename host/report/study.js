// The page of a study.

const axisName = keys => keys.join(", ");
const said = x => (typeof x === "number" ? short(x) : String(x));
const massOf = (x, digits) => (isNumber(x) ? (x * gram).toFixed(digits) : "");

/// Values of an axis in order, and whether they are numbers.
function axisOf(study, a) {
  const values = Array.from(new Set(study.points.map(p => p.at[a])));
  const numeric = values.every(isNumber);
  if (numeric) values.sort((u, v) => u - v);
  return {name: axisName(study.axes[a]), values, numeric};
}

/// Points in lines along axis `a`: one for each place on the others, with its label.
function linesAlong(study, a) {
  const lines = new Map();
  study.points.forEach(p => {
    const label = p.at.map((v, b) => (b === a ? null : `${axisName(study.axes[b])} ${said(v)}`)).filter(t => t !== null).join(", ");
    if (!lines.has(label)) lines.set(label, []);
    lines.get(label).push(p);
  });
  return Array.from(lines, ([label, points]) => ({label, points}));
}

const kMostLines = 12;

/// Some quantity along an axis; `of(point)` gives [value, error].
function alongAxis(parent, study, a, spec, of) {
  const axis = axisOf(study, a);
  if (axis.values.length < 2) return;
  const place = p => (axis.numeric ? p.at[a] : axis.values.indexOf(p.at[a]));
  const lines = linesAlong(study, a), shown = lines.slice(0, kMostLines);
  const series = shown.map((line, i) => ({
    name: line.label || spec.name, colour: colour(i, shown.length), dots: true, line: axis.numeric,
    points: line.points.map(p => [place(p)].concat(of(p))).sort((u, v) => u[0] - v[0]),
  }));
  if (spec.beside) {
    const curves = shown.map(line => line.points.map(p => [place(p), spec.beside.of(p)]).sort((u, v) => u[0] - v[0]));
    const same = curves.every(points => JSON.stringify(points) === JSON.stringify(curves[0]));
    (same ? curves.slice(0, 1) : curves).forEach((points, i) => series.push({
      name: spec.beside.name + (same ? "" : ", each in its colour"), unnamed: i > 0, dash: "6 4", points,
      colour: same ? "var(--s7)" : colour(i, shown.length),
    }));
  }
  const cut = lines.length > shown.length ? ` ${shown.length} of ${lines.length} lines are drawn.` : "";
  chart(parent, {
    title: `${spec.title} against ${axis.name}`, note: (spec.note || "") + cut, level: spec.level, series,
    x: {label: axis.name, categories: axis.numeric ? null : axis.values.map(said), pad: axis.numeric}, y: {label: spec.unit},
  });
}

function betaCharts(parent, study) {
  const target = {value: study.target_kg_per_dose * gram, name: `target ${short(study.target_kg_per_dose * gram)} g/dose`};
  const single = study.points.some(p => !p.error_over_seeds);
  study.axes.forEach((_, a) => alongAxis(parent, study, a, {
    title: "β", name: "β", unit: "g/dose", level: isNumber(study.target_kg_per_dose) ? target : null,
    note: single ? "Bars: standard error over the seeds; with one seed, that of the slope."
                 : "Bars: standard error over the seeds.",
    beside: {name: "closed form", of: p => isNumber(p.closed_form_kg_per_dose) ? p.closed_form_kg_per_dose * gram : null},
  }, p => [isNumber(p.beta_kg_per_dose) ? p.beta_kg_per_dose * gram : null,
           isNumber(p.beta_standard_error_kg_per_dose) ? p.beta_standard_error_kg_per_dose * gram : null]));
}

function calibrationMap(parent, study) {
  if (study.axes.length !== 2) return;
  const [x, y] = [axisOf(study, 0), axisOf(study, 1)];
  if (x.values.length < 2 || y.values.length < 2) return;
  const at = (i, j) => {
    const p = study.points.find(q => q.at[0] === x.values[i] && q.at[1] === y.values[j]);
    return p && isNumber(p.beta_kg_per_dose) ? p.beta_kg_per_dose * gram : null;
  };
  map(parent, {
    title: "β over both axes", x: {label: x.name, values: x.values.map(said)}, y: {label: y.name, values: y.values.map(said)},
    at, unit: "g/dose", target: isNumber(study.target_kg_per_dose) ? study.target_kg_per_dose * gram : null,
    note: "g/dose." + (isNumber(study.target_kg_per_dose) ? " Between neighbours the target's contour is interpolated linearly." : ""),
  });
}

const pointName = (study, p) => p.at.map((v, a) => `${axisName(study.axes[a])} ${said(v)}`).join(", ") || "all members";

function doseCurves(parent, study) {
  const known = study.points.filter(p => p.dose_mass_kg.length > 0);
  const every = Math.ceil(known.length / kMostLines);
  const shown = known.filter((_, i) => i % every === 0);
  const note = every > 1 ? `${shown.length} of ${known.length} points are drawn.` : "";
  const series = of => shown.map((p, i) => ({name: pointName(study, p), colour: colour(i, shown.length), dots: true, points: of(p)}));
  chart(parent, {
    title: "Mass per dose", x: {label: "dose", whole: true, pad: true}, y: {label: "g"}, note: "Bars: standard error over the seeds. " + note,
    series: series(p => p.dose_mass_kg.map(([mean, error], n) => [n + 1, mean * gram, isNumber(error) ? error * gram : null])),
  });
  chart(parent, {
    title: "Cumulative dosed mass", x: {label: "dose", whole: true, pad: true}, y: {label: "g"}, note: "Mean over the seeds. " + note,
    series: series(p => p.cumulative_mass_kg.map((m, n) => [n + 1, m * gram])),
  });
  const turns = known.map(p => p.turns_per_dose);
  if (!turns.every(isNumber) || turns.every(n => n === turns[0])) return;
  chart(parent, {
    title: "Dosed mass over turns of the coil", x: {label: "turns", pad: true}, y: {label: "g"},
    note: "Mean over the seeds. Where doses differ in time or speed alone, one curve says that only turns count. " + note,
    series: series(p => [[0, 0]].concat(p.cumulative_mass_kg.map((m, n) => [(n + 1) * p.turns_per_dose, m * gram]))),
  });
}

function output(p, name, scale) {
  const found = p.outputs[name];
  return found && isNumber(found[0]) ? [found[0] * scale, isNumber(found[1]) ? found[1] * scale : null] : [null, null];
}

function pointTable(main, study) {
  const outcome = p => `${p.finished} done${p.failed ? `, ${p.failed} failed: ${p.errors.join("; ")}` : ""}`;
  table(main, study.axes.map(keys => [axisName(keys), true]).concat(
          [["β [g/dose]", true], ["±", true], ["closed form", true], ["RSD [%]", true], ["doses to 99 %", true], ["members", false]]),
        study.points.map(p => p.at.map(said).concat(
          [massOf(p.beta_kg_per_dose, 3), massOf(p.beta_standard_error_kg_per_dose, 3), massOf(p.closed_form_kg_per_dose, 3),
           short(output(p, "rsd", 100)[0]), short(output(p, "doses_to_99_percent", 1)[0]), outcome(p)])));
}

function verdictTable(main, verdicts) {
  table(main, [["", false], ["published", false], ["section", false], ["here", false], ["verdict", false]],
        verdicts.map(v => {
          const word = document.createElement("span");
          word.textContent = v.verdict;
          word.className = "verdict " + v.kind;
          return [v.id, v.what, v.section, v.found, word];
        }));
}

function studyPage(main, study) {
  const count = study.points.reduce((n, p) => [n[0] + p.finished, n[1] + p.failed], [0, 0]);
  facts(main, [
    {name: "members", value: `${count[0]} done, ${count[1]} failed, ${study.members} in the table`},
    {name: "points", value: String(study.points.length), note: "members that differ in nothing but the seed"},
    {name: "axes", value: study.axes.map(axisName).join("; ") || "none"},
  ]);
  if (study.verdicts) {
    add(main, "h2", "Against published results");
    verdictTable(main, study.verdicts);
  }
  add(main, "h2", "Charts");
  const charts = add(main, "div", null, "charts");
  betaCharts(charts, study);
  calibrationMap(charts, study);
  doseCurves(charts, study);
  if (study.axes.length > 0) {
    alongAxis(charts, study, 0, {title: "Doses to 99 %", name: "doses", unit: "doses"}, p => output(p, "doses_to_99_percent", 1));
    alongAxis(charts, study, 0, {title: "RSD of the doses", name: "RSD", unit: "%"}, p => output(p, "rsd", 100));
  }
  add(main, "h2", "Points");
  pointTable(main, study);
}
