// The page of several runs.

const runColour = (page, i) => colour(i, page.runs.length);

/// A run's name with the colour that its curves have.
function swatch(page, i) {
  const box = document.createElement("span");
  const dot = add(box, "span", "\u25cf ", "swatch");
  dot.style.color = runColour(page, i);
  box.appendChild(document.createTextNode(page.runs[i].label));
  return box;
}

/// Rows of a table of the runs side by side: `rows` [[name, [a value for each run]]].
function sideBySide(parent, page, first, rows, className) {
  table(parent, [[first, false]].concat(page.runs.map(() => ["", false])), rows.map(([name, values]) => [name].concat(values)));
  const element = parent.lastChild.firstChild;
  element.className = className || "runs";
  page.runs.forEach((_, i) => element.querySelectorAll("th")[i + 1].appendChild(swatch(page, i)));
}

function comparedFigures(parent, page) {
  const names = [];
  page.runs.forEach(run => run.facts.forEach(f => { if (!names.includes(f.name)) names.push(f.name); }));
  const cell = (run, name) => {
    const found = run.facts.find(f => f.name === name);
    const box = document.createElement("span");
    if (!found) return box;
    box.textContent = found.value;
    if (found.note) add(box, "small", found.note);
    return box;
  };
  const why = page.runs.some(run => run.why) ? [["case", page.runs.map(run => {
    const box = document.createElement("span");
    box.textContent = run.case_name;
    if (run.why) add(box, "small", run.why);
    return box;
  })]] : [];
  sideBySide(parent, page, "", why.concat(names.map(name => [name, page.runs.map(run => cell(run, name))])));
}

function comparedDoses(parent, page) {
  const most = d3.max(page.runs, run => d3.max(run.doses.dose) || 1);
  const whole = {label: "dose", whole: true, from: 0.5, to: most + 0.5};
  const complete = run => run.doses.dose.map((n, i) => i).filter(i => run.doses.complete[i] === 1);
  const overDoses = (title, column, predicted) => {
    const lines = page.runs.map((run, i) => ({
      name: run.label, colour: runColour(page, i), dots: true, points: complete(run).map(k => [run.doses.dose[k], run.doses[column][k] * gram]),
    }));
    // The closed form of each run that has doses; where all are the same, once.
    const ideal = page.runs.map((run, i) => ({name: "closed form", colour: runColour(page, i), dash: "6 4", points: predicted(run, complete(run))}))
      .filter(line => line.points.length > 0);
    const same = ideal.every(line => line.points[0][1] === ideal[0].points[0][1]);
    const dashed = same ? ideal.slice(0, 1).map(line => Object.assign(line, {colour: "var(--s7)"}))
                        : ideal.map((line, i) => Object.assign(line, {name: "closed form, each in its colour", unnamed: i > 0}));
    chart(parent, {title, x: whole, y: {label: "g"}, series: lines.concat(dashed)});
  };
  overDoses("Cumulative dosed mass", "cumulative_mass_kg", (run, list) => list.filter(i => run.doses.closed_form_mass_kg[i] > 0)
    .flatMap(i => [-0.5, 0.5].map(half => [run.doses.dose[i] + half,
                                           Math.min(run.filled_mass_kg, closedSums(run.doses)[i] + half * run.doses.closed_form_mass_kg[i]) * gram])));
  overDoses("Mass per dose", "mass_kg", (run, list) => list.filter(i => run.doses.closed_form_mass_kg[i] > 0)
    .flatMap(i => [-0.5, 0.5].map(half => [run.doses.dose[i] + half, run.doses.closed_form_mass_kg[i] * gram])));
}

function comparedTimes(parent, page) {
  const time = {label: "time [s]", from: 0, to: d3.max(page.runs, run => d3.max(run.series.time_s))};
  const first = d3.min(page.runs, run => (run.rotations.length > 0 ? run.rotations[0][0] : null));
  const overTime = (title, unit, column, scale, note, scaled) => chart(parent, {
    title, x: time, y: {label: unit, scaledFrom: scaled ? first : null}, note,
    series: page.runs.map((run, i) => ({name: run.label, colour: runColour(page, i), thin: true, points: zip(run.series.time_s, run.series[column], scale)})),
  });
  overTime("Dosed mass", "g", "dosed_mass_kg", gram);
  overTime("Torque of the drive", "mN m", "coil_torque_Nm", milli, "Mean between two lines of the time series.", true);
  overTime("Power of the drive", "mW", "coil_power_W", milli, "Torque times speed.", true);
  overTime("Outlet velocity", "mm/s", "outlet_velocity_m_s", milli, "Mean v_z of the mass in the throat; no curve where that is empty.", true);
}

function comparedKeys(parent, page) {
  const rows = list => list.map(k => [k.key, k.values.map(v => (v === "" ? "\u2013" : v))]);
  const different = page.keys.filter(k => !k.same), same = page.keys.filter(k => k.same);
  add(parent, "h2", "What differs between the cases");
  if (different.length > 0)
    sideBySide(parent, page, "key", rows(different), "runs keys");
  else
    add(parent, "p", "The cases are the same, key by key.");
  const details = add(parent, "details");
  add(details, "summary", `${same.length} keys that are the same in all`);
  table(details, [["key", false], ["value", false]], same.map(k => [k.key, k.values[0]]));
}

function runsPage(main, page) {
  comparedKeys(main, page);
  add(main, "h2", "Charts");
  const charts = add(main, "div", null, "charts");
  if (page.runs.some(run => run.doses.dose.length > 0)) comparedDoses(charts, page);
  if (page.runs.some(run => run.series.time_s.length > 1)) comparedTimes(charts, page);
  add(main, "h2", "Figures");
  comparedFigures(main, page);
}
