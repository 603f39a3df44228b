// The page of a study.

const axisName = keys => keys.join(", ");
const said = x => (typeof x === "number" ? short(x) : String(x));

/// Values of an axis in order, and whether numbers tell them apart. Keys that move together are drawn along the first.
function axisOf(study, a) {
  const along = new Map(study.points.map(p => [p.at[a], p.along[a]]));
  const values = Array.from(along.keys());
  const numeric = values.every(v => isNumber(along.get(v))) && new Set(along.values()).size === values.length;
  if (numeric) values.sort((u, v) => along.get(u) - along.get(v));
  return {name: numeric ? study.axes[a][0] : axisName(study.axes[a]), values, numeric};
}

/// Where a point lies on axis `a`: "coil.turns 8".
function placeOn(axis, a, p) {
  return `${axis.name} ${said(axis.numeric ? p.along[a] : p.at[a])}`;
}

/// Points in lines along axis `a`: one for each place on the others, with its label.
function linesAlong(study, a) {
  const lines = new Map(), axes = study.axes.map((_, b) => axisOf(study, b));
  study.points.forEach(p => {
    const label = axes.map((axis, b) => (b === a ? null : placeOn(axis, b, p))).filter(t => t !== null).join(", ");
    if (!lines.has(label)) lines.set(label, []);
    lines.get(label).push(p);
  });
  return Array.from(lines, ([label, points]) => ({label, points}));
}

const kMostLines = 12;

/// Some quantity along an axis; `of(point)` gives [value, error]. A point without one has that of `spec.instead`, drawn hollow.
function alongAxis(parent, study, a, spec, of) {
  const axis = axisOf(study, a);
  if (axis.values.length < 2) return;
  const place = p => (axis.numeric ? p.along[a] : axis.values.indexOf(p.at[a]));
  const lines = linesAlong(study, a), shown = lines.slice(0, kMostLines);
  const series = shown.map((line, i) => ({
    name: line.label || spec.name, colour: colour(i, shown.length), dots: true, line: axis.numeric,
    points: line.points.map(p => [place(p)].concat(of(p))).sort((u, v) => u[0] - v[0]),
  }));
  if (spec.instead) {
    let named = false;
    shown.forEach((line, i) => {
      const without = line.points.filter(p => !isNumber(of(p)[0]) && isNumber(spec.instead.of(p)[0]));
      if (without.length === 0) return;
      series.push({name: spec.instead.name, unnamed: named, colour: colour(i, shown.length), dots: true, hollow: true, line: false,
                   points: without.map(p => [place(p)].concat(spec.instead.of(p)))});
      named = true;
    });
  }
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
    instead: {name: "mean dose, where there is no slope", of: p => output(p, "mean_dose_kg", gram)},
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

const pointName = (study, p) => study.axes.map((_, a) => placeOn(axisOf(study, a), a, p)).join(", ") || "all members";

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
  const figures = [
    ["β [g/dose]", p => gramsText(p.beta_kg_per_dose)], ["±", p => gramsText(p.beta_standard_error_kg_per_dose)],
    ["closed form", p => (p.closed_form_kg_per_dose > 0 ? gramsText(p.closed_form_kg_per_dose) : "")], ["RSD [%]", p => short(output(p, "rsd", 100)[0])],
    ["doses to 99 %", p => short(output(p, "doses_to_99_percent", 1)[0])],
  ].filter(([, of]) => study.points.some(p => of(p) !== ""));
  table(main, study.axes.map(keys => [axisName(keys), true]).concat(figures.map(([name]) => [name, true]), [["members", false]]),
        study.points.map(p => p.at.map(said).concat(figures.map(([, of]) => of(p)), [outcome(p)])));
}

const rounded2 = x => Math.round(x * 100) / 100;
const rounded = (x, digits) => (isNumber(x) ? String(Number(x.toPrecision(digits))) : "");
const within = (value, error) => `${short(value)} ± ${rounded(error, 2) || "?"}`;
const figureName = t => (t.name === "beta" ? "β" : t.name);
const inUnit = t => (t.unit ? " " + t.unit : "");
const signed = x => (isNumber(x) && x > 0 ? "+" : "") + rounded(x, 3);

/// A parameter at the points that were tried, and the target by which it is known best.
function parameterChart(parent, found, k) {
  const p = found.parameters[k], g = p.mostly_by, t = found.targets[g];
  const series = (name, shade, points) => ({
    name, colour: shade, dots: true, line: false, points: points.map(q => [q.at[k], q.values[g][0], q.values[g][1]]),
  });
  chart(parent, {
    title: `${figureName(t)} against ${p.key}`, x: {label: p.key, pad: true}, y: {label: t.unit || figureName(t), zero: false},
    level: {value: t.value, name: `target ${within(t.value, t.uncertainty)}${inUnit(t)}`},
    series: [series("points tried", "var(--s0)", found.points.filter((_, i) => i !== found.best)),
             series("chosen", "var(--s1)", [found.points[found.best]])],
    note: "All parameters differ from point to point. Bars: standard error.",
  });
}

/// Two parameters at the draws: a cloud, or the ridge along which they compensate. The frame is that of the bounds.
function pairChart(parent, study, i, j) {
  const found = study.calibration, [x, y] = [found.parameters[i], found.parameters[j]];
  chart(parent, {
    title: `${y.key} over ${x.key}`, x: {label: x.key, from: x.low, to: x.high}, y: {label: y.key, from: y.low, to: y.high},
    series: [{name: "values that fit", colour: "var(--s0)", dots: true, line: false, points: study.draws.map(d => [d[i], d[j]])},
             {name: "chosen", colour: "var(--s1)", dots: true, line: false, points: [[x.chosen, y.chosen]]}],
    note: `Correlation ${signed(rounded2(found.fit.correlation[i][j]))}. The frame is that of the bounds.`,
  });
}

/// How a parameter is known, in words.
function knownText(found, k) {
  const p = found.parameters[k], others = found.fit.compensations.filter(pair => pair.includes(k)).map(pair => pair[0] === k ? pair[1] : pair[0]);
  if (others.length > 0) return `only together with ${others.map(j => found.parameters[j].key).join(" and ")}`;
  return p.constrained ? `mostly by ${figureName(found.targets[p.mostly_by])}` : "the targets do not constrain it within its bounds";
}

const kSurrogateWords = {
  honest: "", cautious: "less sure than it may be: intervals are wider than need be",
  overconfident: "surer than it may be: intervals are too narrow", blind: "predicts little: too few points, or a figure that hardly moves",
};

/// What the surrogates are worth, and what values fit.
function fitPart(part, study) {
  const found = study.calibration, fit = found.fit;
  table(part, [["surrogate of", false], ["off by", true], ["over what it expects", true], ["at most", true], ["predictive R²", true], ["", false]],
        found.targets.map(t => {
          const l = t.leave_one_out;
          return [figureName(t), rounded(l.error, 2) + inUnit(t), rounded(l.standardised_error, 2), rounded(l.largest_standardised_error, 2),
                  rounded(l.predictive_r2, 2), kSurrogateWords[l.verdict]];
        }));
  add(part, "p", `Each of the ${found.targets[0].leave_one_out.points} points is predicted from the others. Errors over what is expected of them are of order one.`);
  table(part, [["parameter", false], ["bounds", true], ["chosen", true], ["median that fits", true], ["95 % of what fits", true]].concat(
          found.targets.map(t => [`change of ${figureName(t)}`, true]), [["known", false]]),
        found.parameters.map((p, k) => [p.key, `${short(p.low)} to ${short(p.high)}`, short(p.chosen), short(p.median),
                                        `${short(p.interval_95[0])} to ${short(p.interval_95[1])}`].concat(
          p.change_in_uncertainties.map(signed), [knownText(found, k)])));
  fit.compensations.forEach(([i, j]) => add(part, "p", `${found.parameters[i].key} and ${found.parameters[j].key} compensate ` +
      `(correlation ${signed(rounded2(fit.correlation[i][j]))}): only their combination is known.`));
  found.targets.forEach((t, g) => {
    if (!fit.figures[g].reached) add(part, "p", `Where values within the bounds fit best, ${figureName(t)} is ` +
      `${within(fit.figures[g].mean, fit.figures[g].deviation)} for ${within(t.value, t.uncertainty)}${inUnit(t)}: out of reach, or not together with the others.`);
  });
  add(part, "p", `What fits is told by ${fit.sampled} points sampled from its distribution (${fit.method}; R-hat ${rounded(fit.r_hat, 4)}, ` +
      `${rounded(fit.effective, 2)} effective). Changes are from bound to bound by the slope at the chosen point, in uncertainties of the target.`);
}

/// The runs with new seeds, by which a target is met or not.
function confirmationTable(parent, found) {
  if (found.confirmations.length === 0) {
    add(parent, "p", "No point is believed to meet every target, so none was run with new seeds.");
    return;
  }
  const seeds = found.confirming_seeds;
  table(parent, [["confirmed at", false], ["target", false], ["measured", true], [`runs with seeds ${seeds.join(", ")}`, true], ["verdict", false]],
        found.confirmations.flatMap(c => c.figures.map((f, g) => {
          const t = found.targets[g];
          const some = f.verdict === "incomplete" ? `, ${f.runs} of ${seeds.length} runs have the figure` : "";
          return [g === 0 ? c.at : "", figureName(t), within(t.value, t.uncertainty) + inUnit(t),
                  isNumber(f.mean) ? within(f.mean, f.error) + inUnit(t) : "none", f.verdict + some];
        })));
}

function calibrationPart(main, study) {
  const found = study.calibration;
  if (study.designs || (!found && !study.searches)) return;
  add(main, "h2", "Calibration");
  const part = add(main, "section", null, "calibration");
  if (!found) {
    add(part, "p", "The search has not ended; what it found is shown when it has.");
    return;
  }
  const one = found.targets.length === 1, searched = found.points.length > 0;
  const known = [{name: one ? "target" : "targets",
                  value: (found.met ? "met" : "NOT met") + (searched ? ` after ${found.points.length} points` : ""),
                  note: "met: runs with new seeds at the chosen point give it to within the uncertainty, with an error within it"}];
  if (searched) known.push({name: "misfit", value: rounded(found.misfit, 3), note: "believed: weighted sum of squares over uncertainties"});
  facts(part, known);
  confirmationTable(part, found);
  table(part, [["target", false], ["case", false], ["measured", true],
               [searched ? "believed at the chosen point" : "interpolated at the chosen point", true], ["weight", true]],
        found.targets.map(t => [figureName(t), t.base, within(t.value, t.uncertainty) + inUnit(t),
                                 (searched ? within(t.believed, t.deviation) : short(t.believed)) + inUnit(t), short(t.weight)]));
  if (!searched) return;
  fitPart(part, study);
  const charts = add(part, "div", null, "charts");
  found.parameters.forEach((_, j) => d3.range(j).forEach(i => pairChart(charts, study, i, j)));
  found.parameters.forEach((_, k) => parameterChart(charts, found, k));
}

const asked = g => [g.wish === "none" ? null : g.wish, isNumber(g.at_least) ? `at least ${short(g.at_least)}` : null,
                    isNumber(g.at_most) ? `at most ${short(g.at_most)}` : null].filter(Boolean).join(", ");

/// The points of a design over two of its wishes, or over its first parameter if there is one wish.
function frontChart(parent, found) {
  const wished = found.goals.map((g, i) => i).filter(i => found.goals[i].wish !== "none");
  const [y, x] = wished;
  const across = (p, values) => (x === undefined ? p.at[0] : values[x][0]);
  const series = (name, shade, points, line) => ({name, colour: shade, dots: true, line, points});
  const of = points => points.map(p => [across(p, p.figures || p.values), ...(p.figures || p.values)[y]])
                             .filter(([a, b]) => isNumber(a) && isNumber(b)).sort((a, b) => a[0] - b[0]);
  const front = found.front.filter(p => p.verdict === "on the front");
  const others = found.points.filter((_, i) => !front.some(p => p.point === i));
  chart(parent, {
    title: "The front", x: {label: x === undefined ? found.parameters[0].key : found.goals[x].name, pad: true},
    y: {label: found.goals[y].name, zero: false},
    series: [series("points tried", "var(--s0)", of(others), false), series("front, by runs with new seeds", "var(--s1)", of(front), true)],
    note: "Bars: standard error.",
  });
}

function designPart(main, study) {
  const found = study.design;
  if (!study.designs) return;
  add(main, "h2", "Design");
  const part = add(main, "section", null, "design");
  if (!found) {
    add(part, "p", "The search has not ended; what it found is shown when it has.");
    return;
  }
  table(part, [["goal", false], ["case", false], ["wish", false]], found.goals.map(g => [g.name, g.base, asked(g)]));
  if (found.front.length === 0) {
    add(part, "p", "No point keeps the bounds of its goals.");
  } else {
    table(part, found.parameters.map(p => [p.key, true]).concat(found.goals.map(g => [g.name, true]), [["verdict", false]]),
          found.front.map(p => p.at.map(short).concat(p.figures.map(([mean, error]) => (isNumber(mean) ? within(mean, error) : "none")), [p.verdict])));
    add(part, "p", `Figures are those of runs with the new seeds ${found.confirming_seeds.join(", ")}, because a point is chosen ` +
        "partly by the chance of its first runs.");
  }
  frontChart(add(part, "div", null, "charts"), found);
}

/// The figures of a device with draws of its powder.
function predictionPart(main, study) {
  const found = study.prediction;
  if (!found) return;
  add(main, "h2", "Prediction");
  const part = add(main, "section", null, "prediction");
  const failed = found.failed > 0 ? `, of which ${found.failed} failed` : "";
  add(part, "p", `${found.draws} draws of the powder's parameters${failed}. One more run with another draw is to be expected ` +
      `within the interval with a chance of ${Math.round(100 * found.chance)} %.`);
  table(part, [["figure", false], ["mean", true], ["from", true], ["to", true], ["draws that have it", true]],
        found.figures.map(f => [f.name, short(f.mean), isNumber(f.low) ? short(f.low) : "?", isNumber(f.high) ? short(f.high) : "?",
                                String(f.draws)]));
}

/// Which figures of a case hold with larger spheres.
function scalePart(main, study) {
  const found = study.scale;
  if (!found) return;
  add(main, "h2", "Size of the spheres");
  const part = add(main, "section", null, "scale");
  const gaps = Object.keys(found.sizes[0].widths_in_diameters);
  table(part, [["size", true], ["mean diameter [mm]", true], ["particles", true]].concat(gaps.map(g => [`${g} in diameters`, true])),
        found.sizes.map(s => [short(s.factor), short(1e3 * s.mean_diameter_m), String(s.particles)]
            .concat(gaps.map(g => short(s.widths_in_diameters[g])))));
  add(part, "p", `Each figure is held against that of the smallest spheres, to ${rounded(100 * found.within, 3)} %. Open: the seeds do not tell.`);
  table(part, [["figure", false]].concat(found.sizes.map(s => [`size ${short(s.factor)}`, true]), [["holds up to", true]]),
        found.figures.map(f => [f.name].concat(
            f.at.map((m, k) => (isNumber(m.mean) ? within(m.mean, m.error) : "none") + (k > 0 ? `, ${m.verdict}` : "")),
            [short(f.holds_to_factor)])));
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
  calibrationPart(main, study);
  designPart(main, study);
  predictionPart(main, study);
  scalePart(main, study);
  const heading = add(main, "h2", "Charts");
  const charts = add(main, "div", null, "charts");
  // The points of a search and the draws of a powder lie on no lines along the parameters.
  const scattered = study.searches || Boolean(study.prediction);
  if (!scattered) {
    betaCharts(charts, study);
    calibrationMap(charts, study);
  }
  doseCurves(charts, study);
  if (study.axes.length > 0 && !scattered) {
    alongAxis(charts, study, 0, {title: "Doses to 99 %", name: "doses", unit: "doses"}, p => output(p, "doses_to_99_percent", 1));
    alongAxis(charts, study, 0, {title: "RSD of the doses", name: "RSD", unit: "%"}, p => output(p, "rsd", 100));
  }
  if (!charts.hasChildNodes()) heading.remove();
  add(main, "h2", "Points");
  pointTable(main, study);
}
