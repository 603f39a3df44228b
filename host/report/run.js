// The page of a run.

const gram = 1e3, milli = 1e3;
const zip = (x, y, scale) => x.map((t, i) => [t, isNumber(y[i]) ? y[i] * scale : null]);

function factRows(box, list) {
  list.forEach(fact => {
    const row = add(box, "div");
    add(row, "dt", fact.name);
    const value = add(row, "dd", fact.value);
    if (fact.note) add(value, "small", fact.note);
  });
}

const facts = (main, list) => factRows(add(main, "dl", null, "facts"), list);

/// Ties a chart over time, or over doses, to the player, if there is one.
const overTime = run => run.player && {place: () => clock.time, jump: t => clock.jump(t), listen: f => clock.follow(f)};
const overDoses = run => run.player && {
  place: () => (clock.time === null ? null : clock.dose()), listen: f => clock.follow(f),
  jump: n => {
    const start = clock.time === null ? null : clock.doseStart(Math.round(n));
    if (isNumber(start)) clock.jump(start);
  },
};

/// What the closed form says of each dose and of those before it together [kg]; an order to the drive changes a dose.
function closedSums(doses) {
  let sum = 0;
  return doses.closed_form_mass_kg.map(m => (sum += m > 0 ? m : 0));
}

function doseCharts(parent, run) {
  const d = run.doses, e = run.experiment;
  const complete = d.dose.map((n, i) => i).filter(i => d.complete[i] === 1);
  const at = values => complete.map(i => [d.dose[i], values[i] * gram]);
  const closed = complete.filter(i => d.closed_form_mass_kg[i] > 0);
  const measured = {name: "simulation", colour: "var(--s0)", dots: true};
  const predicted = {name: "closed form", colour: "var(--s7)", dash: "6 4"};
  const balance = e && {name: `experiment (${e.name})`, colour: "var(--s1)", dots: true, hollow: true};
  const whole = {label: "dose", whole: true, from: 0.5, to: Math.max(d3.max(d.dose) || 1, e ? d3.max(e.dose) : 1) + 0.5};

  // The line of the closed form spans each dose, so that it shows with a single one too.
  const spanned = (points, at) => points.length === 0 ? [] : [[points[0][0] - 0.5, at(points[0], -0.5)]].concat(points,
    [[points[points.length - 1][0] + 0.5, at(points[points.length - 1], 0.5)]]);
  const sums = closedSums(d), ideal = closed.map(i => [d.dose[i], Math.min(run.filled_mass_kg, sums[i]) * gram, d.closed_form_mass_kg[i] * gram]);
  chart(parent, {
    title: "Cumulative dosed mass", link: overDoses(run), x: whole, y: {label: "g"},
    level: {value: run.beta_below_kg * gram, name: `β is taken below ${short(run.beta_below_kg * gram)} g`},
    series: [Object.assign({points: at(d.cumulative_mass_kg)}, measured), Object.assign({points: spanned(ideal, ([, sum, each], half) => Math.min(run.filled_mass_kg * gram, sum + half * each)).map(p => p.slice(0, 2))}, predicted)]
      .concat(e ? [Object.assign({points: zip(e.dose, e.cumulative_mass_kg, gram)}, balance)] : []),
  });
  chart(parent, {
    title: "Mass per dose", link: overDoses(run), x: whole, y: {label: "g"},
    series: [Object.assign({points: at(d.mass_kg)}, measured),
             Object.assign({points: spanned(closed.map(i => [d.dose[i], d.closed_form_mass_kg[i] * gram]), p => p[1])}, predicted)]
      .concat(e ? [Object.assign({points: zip(e.dose, e.mass_kg, gram)}, balance)] : []),
  });
}

/// Force, torque and power of each body over time.
function bodyCharts(parent, run, time) {
  const s = run.series, note = "Of the particles on the body, mean between two lines of the time series.";
  const drawn = (title, unit, scale, curves, told) => chart(parent, {
    title, link: overTime(run), x: time, y: {label: unit}, bands: run.rotations, note: told,
    series: curves.map(([name, values, colour]) => ({name, points: zip(s.time_s, values, scale), colour, thin: true})),
  });
  (s.bodies || []).forEach(b => {
    drawn(`Force on ${b.name}`, "N", 1, [["along x", b.force_x_N, "var(--s0)"], ["along y", b.force_y_N, "var(--s1)"],
                                         ["along z", b.force_z_N, "var(--s2)"]], note);
    if (!b.torque_Nm) return;
    drawn(`Torque on ${b.name}`, "mN m", milli, [["about its axis", b.torque_Nm, "var(--s0)"]], note);
    if (b.power_W.some(p => p !== 0))
      drawn(`Power of ${b.name}`, "mW", milli, [["on the particles", b.power_W, "var(--s3)"]], "Mean between two lines of the time series.");
  });
}

/// A line of mass over time for each region of the list.
function regionChart(parent, run, time, regions, title, note) {
  if (!regions || regions.length === 0) return;
  chart(parent, {
    title, link: overTime(run), x: time, y: {label: "g"}, bands: run.rotations, note,
    series: regions.map((r, i) => ({name: r.name, points: zip(run.series.time_s, r.mass_kg, gram),
                                    colour: colour(i, regions.length), thin: true})),
  });
}

/// The mass of each powder that has been dosed, where there are several.
function powderChart(parent, run, time) {
  const s = run.series, powders = s.powders || [];
  if (powders.length === 0) return;
  chart(parent, {
    title: "Dosed mass of each powder", link: overTime(run), x: time, y: {label: "g"}, bands: run.rotations,
    series: powders.map((p, i) => ({name: p.name, points: zip(s.time_s, p.mass_kg, gram), colour: colour(i, powders.length), thin: true})),
    note: "Since the start of the run.",
  });
}

/// The mass rate window by window, with the part that is steady.
function rateChart(parent, run, time) {
  const r = run.rate, from = isNumber(r.steady) ? r.steady : r.time_s.length, dots = r.time_s.length <= 100;
  if (r.time_s.length < 2) return;
  const points = zip(r.time_s, r.kg_s, gram), steady = {value: r.steady_kg_s * gram, name: "mean of the steady part"};
  chart(parent, {
    title: "Mass rate", link: overTime(run), x: time, y: {label: "g/s"}, bands: run.rotations, level: isNumber(r.steady) ? steady : null,
    series: [{name: from < points.length ? "before the steady part" : "in windows", points: points.slice(0, from + 1), colour: "var(--s1)", dots, hollow: true},
             {name: "steady part", points: points.slice(from), colour: "var(--s0)", dots}],
    note: `In windows of ${short(r.window_s)} s in which the drive turns; the steady part is found by MSER-5.`,
  });
}

/// The mass of each cycle against what was left in the device: the feed factor.
function cycleChart(parent, run) {
  const c = run.cycles;
  if (c.time_s.length < 2) return;
  const from = isNumber(c.steady) ? c.steady : c.time_s.length;
  const points = c.left_kg.map((left, i) => [left * gram, c.mass_kg[i] * gram]);
  const steady = {value: c.steady_kg * gram, name: "mean of the steady part"};
  chart(parent, {
    title: `Mass of a ${c.is} against the mass left`, x: {label: "left in the device at its start [g]", pad: true}, y: {label: "g"},
    level: isNumber(c.steady) ? steady : null,
    series: [{name: from < points.length ? "before the steady part" : "in order of time", points: points.slice(0, from + 1), colour: "var(--s1)", dots: true, hollow: true, thin: true},
             {name: "steady part", points: points.slice(from), colour: "var(--s0)", dots: true, thin: true}],
    note: "Joined in order of time. Only what comes out while the drive turns forward counts; the steady part is found by MSER-5.",
  });
}

const timeAxis = run => ({label: "time [s]", from: 0, to: d3.max(run.series.time_s)});

function flowCharts(parent, run) {
  rateChart(parent, run, timeAxis(run));
  cycleChart(parent, run);
}

function timeCharts(parent, run) {
  const s = run.series, turning = "Shaded: powder is dosed; numbered by dose.", time = timeAxis(run);
  // What a device does not have, such as a drive or a throat, has no curve.
  const curve = (title, unit, name, values, scale, colour, note) => values.some(v => isNumber(v) && v !== 0) && chart(parent, {
    title, link: overTime(run), x: time, y: {label: unit, scaledFrom: run.rotations.length > 0 ? run.rotations[0][0] : null}, bands: run.rotations, note: note || turning,
    series: [{name, points: zip(s.time_s, values, scale), colour, thin: true}],
  });
  curve("Torque of the drive", "mN m", "mean between two lines of the time series", s.coil_torque_Nm, milli, "var(--s0)");
  curve("Power of the drive", "mW", "torque times speed", s.coil_power_W, milli, "var(--s3)");
  curve("Outlet velocity", "mm/s", "mean v_z of the mass in the throat", s.outlet_velocity_m_s, milli, "var(--s2)",
        turning + " No curve where the throat is empty; what falls out while settling may leave the frame.");
  if (!run.rate_leads) flowCharts(parent, run);
  regionChart(parent, run, time, run.series.regions, "Mass that came into regions",
              "Each particle counts once for a region, since the start of the run.");
  regionChart(parent, run, time, run.series.contents, "Mass in regions", "What is in the region at the time.");
  powderChart(parent, run, time);
  bodyCharts(parent, run, time);

  let below = s.time_s.map(() => 0);
  const layers = [["dosed", s.dosed_mass_kg, "var(--s0)"], ["throat", s.throat_mass_kg, "var(--s4)"],
                  [run.holds, s.canister_mass_kg, "var(--s2)"], ["lost", s.lost_mass_kg, "var(--s6)"]]
    .filter(([name, values]) => (name !== "lost" && name !== "throat") || d3.max(values) > 0)
    .map(([name, values, colour]) => {
      const points = s.time_s.map((t, i) => [t, below[i] + values[i] * gram, below[i]]);
      below = points.map(p => p[1]);
      return {name, points, colour, area: true};
    });
  chart(parent, {title: "Where the powder is", link: overTime(run), x: time, y: {label: "g"}, series: layers,
                 note: "The ledger: together always what was filled."});
}

/// The states of the bed that are shown: every n-th from the settled bed on, which are at most this many, then the
/// last, and those of `wanted` doses.
const kMostStates = 8;
function everyFewDoses(states, wanted) {
  const every = Math.ceil(states.length / kMostStates);
  return states.filter((state, i) => i % every === 0 || i === states.length - 1 || wanted.has(state.dose));
}

const doseName = dose => (dose === 0 ? "settled" : `dose ${dose}`);

function surfaceChart(parent, run) {
  const s = run.surface, inMillimetres = list => list.map(x => x * milli);
  const states = everyFewDoses(s.states, new Set(s.photographs.map(p => p.dose)));
  const shade = new Map(states.map((state, i) => [state.dose, colour(i, states.length)]));
  const now = {name: "in the player", points: [], colour: "var(--ink)"};
  const series = states.map(state => ({
    name: doseName(state.dose), points: zip(inMillimetres(s.z_m), state.height_m, milli), colour: shade.get(state.dose), thin: true,
  })).concat(s.photographs.map(p => ({
    name: `${p.name}, ${doseName(p.dose)}`, points: zip(inMillimetres(p.z_m), p.height_m, milli), colour: shade.get(p.dose), dash: "7 4",
  })));
  const place = run.player && run.player.columns > 0 ? [now] : [];
  if (place.length > 0) now.points = series[0].points.slice();
  const again = chart(parent, {
    title: "Surface of the powder", x: {label: "z [mm]", from: 0, to: s.length_m * milli}, y: {label: "mm"}, series: series.concat(place),
    note: "As seen from the side, over the floor's lowest point, at the end of each dose; the outlet is on the right."
      + (s.photographs.length > 0 ? " Dashed: measured on photographs." : ""),
  });
  if (place.length === 0) return;
  clock.follow(() => {
    const frames = run.player.unpacked, k = run.player.columns;
    if (!frames) return;
    const size = (run.player.high[1] - run.player.low[1]) / 65535;
    now.points = s.z_m.map((z, i) => [z * milli, frames.surface[clock.frame * k + i] * size * milli]);
    again();
  });
}

function doseTable(main, d) {
  const g = gramsText;
  if ((d.target_mass_kg || []).some(x => x > 0) || d.stopped_by.includes("torque"))
    table(main, [["dose", true], ["target [g]", true], ["mass [g]", true], ["at the stop [g]", true], ["overshoot [g]", true],
                 ["turned [s]", true], ["stopped by", false]],
          d.dose.map((n, i) => [n, g(d.target_mass_kg[i]), g(d.mass_kg[i]), g(d.stop_mass_kg[i]), g(d.overshoot_kg[i]),
                                short(d.rotation_s[i]), d.stopped_by[i]]));
  table(main, [["dose", true], ["begins at [s]", true], ["mass [g]", true], ["cumulative [g]", true], ["particles", true],
               ["torque [mN m]", true], ["closed form [g]", true], ["longest stop [s]", true], ["arch [mm]", true], ["", false]],
        d.dose.map((n, i) => [n, short(d.start_time_s[i]), g(d.mass_kg[i]), g(d.cumulative_mass_kg[i]), d.particles[i],
                              g(d.coil_torque_Nm[i]), g(d.closed_form_mass_kg[i]),
                              short(d.longest_stop_s[i]), isNumber(d.arch_m[i]) ? short(d.arch_m[i] * milli) : "",
                              d.complete[i] === 1 ? "" : "incomplete, in no statistics"]));
}

/// The loads of each body in each dose, whose columns begin with its name and a dot.
function loadTables(main, d) {
  const last = ".torque_Nm", of = (name, what, scale) => d[`${name}.${what}`].map(x => short(x * scale));
  Object.keys(d).filter(column => column.endsWith(last)).map(column => column.slice(0, -last.length)).forEach(name => {
    const columns = [of(name, "force_x_N", 1), of(name, "force_y_N", 1), of(name, "force_z_N", 1), of(name, "torque_Nm", milli),
                     of(name, "power_W", milli), of(name, "work_J", milli)];
    add(main, "h3", `Loads of ${name}`);
    table(main, [["dose", true], ["force along x [N]", true], ["y [N]", true], ["z [N]", true], ["torque [mN m]", true],
                 ["power [mW]", true], ["work [mJ]", true]], d.dose.map((n, i) => [n].concat(columns.map(c => c[i]))));
  });
}

function runPage(main, run) {
  facts(main, run.facts);
  add(main, "h2", "Charts");
  const charts = add(main, "div", null, "charts");
  if (run.player) playerFigure(charts, run.player);
  if (run.rate_leads) flowCharts(charts, run);
  if (run.doses.dose.length > 0 && !run.rate_leads) doseCharts(charts, run);
  if (run.surface) surfaceChart(charts, run);
  fieldFigures(charts, run);
  if (run.series.time_s.length > 1) timeCharts(charts, run);
  if (run.doses.dose.length > 0) {
    add(main, "h2", "Doses");
    doseTable(main, run.doses);
    loadTables(main, run.doses);
  }
  const details = add(main, "details");
  add(details, "summary", "The case, with every default");
  add(details, "pre", run.case);
}
