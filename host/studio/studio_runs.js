// Runs: live, stopped, gone on with, ordered about, compared and exported.

const live = {run: null, source: null};

const kDoseColumns = ["dose", "mass_kg", "cumulative_mass_kg", "complete", "closed_form_mass_kg"];

/// Shows where the run is, in words, as a bar and as charts.
function drawRun() {
  clearTimeout(live.drawing);
  Object.assign(live, {drawing: 0, drawn: Date.now()});
  tellPlace();
  const box = at("charts");
  drawings.length = 0;
  box.textContent = "";
  if (live.doses.dose.length > 0) doseCharts(box, {doses: live.doses, filled_mass_kg: live.filled, beta_below_kg: NaN});
  const series = (title, key, unit, scale) => {
    const points = live.samples.map(s => [s.time_s, isNumber(s[key]) ? s[key] * scale : null]);
    chart(box, {title, x: {label: "s"}, y: {label: unit}, series: [{name: title, unnamed: true, points, colour: "var(--s0)", thin: true}]});
  };
  series("Dosed mass", "dosed_mass_kg", "g", gram);
  series("Torque of the coil", "coil_torque_Nm", "mN m", milli);
  drawings.forEach(again => again());
}

function tellPlace() {
  const last = live.samples[live.samples.length - 1];
  if (!last || !live.source || live.study) return;
  if (live.expected > 0 && isNumber(last.step)) at("progress").value = Math.min(1, last.step / live.expected);
  at("live-state").textContent = `${live.phase || "settling"}, t = ${last.time_s.toFixed(3)} s${leftText(last.step)}`;
}

/// What the page draws it takes from the run, where both share the processor. So it draws every two seconds, however many
/// samples come.
const kDrawAfter = 2000;  // ms
function drawSoon() {
  live.drawing = live.drawing || setTimeout(drawRun, Math.max(0, (live.drawn || 0) + kDrawAfter - Date.now()));
}

const kSamples = 2000;  // kept; beyond, every other one goes

/// How long the run will still take, by what it has done since the page watches it.
function leftText(step) {
  if (!(live.expected > 0) || !isNumber(step)) return "";
  const now = Date.now();
  if (!live.first) live.first = {step, now};
  const made = step - live.first.step, rest = live.expected - step;
  if (now - live.first.now < 3000 || made <= 0 || rest <= 0) return "";
  return `, about ${timeText(rest * (now - live.first.now) / made / 1000)} left`;
}

function take(event) {
  if (event.event === "run") {
    live.filled = event.filled_kg;
    showRefills(event.refills);
    tried(list)();  // the run has its folder now
  }
  if (event.event === "refill") refillButtons().filter(b => b.value === event.name).forEach(b => { b.disabled = true; });
  if (event.event === "phase") {
    live.expected = event.expected_steps;
    live.phase = event.phase === "settle" ? "settling" : `dose ${event.dose}, ${event.phase}`;
    tellPlace();
  }
  if (event.event === "sample") {
    if (live.samples.length === 0 || event.time_s > live.samples[live.samples.length - 1].time_s) live.samples.push(event);
    if (live.samples.length > kSamples) live.samples = live.samples.filter((_, i) => i % 2 === 0);
  }
  if (event.event === "dose") {
    // A dose that was cut off by a stop is there already, and comes again whole.
    const known = live.doses.dose.indexOf(event.dose), place = known < 0 ? live.doses.dose.length : known;
    kDoseColumns.forEach(k => { live.doses[k][place] = k === "complete" ? Number(event[k]) : event[k]; });
  }
  if (event.event === "order")
    at("order-state").textContent = event.order === "stop" ? `stopped at t = ${event.time_s.toFixed(3)} s` : `${short(event.speed_rpm)} rpm from t = ${event.time_s.toFixed(3)} s`;
  if (event.event === "refused") say(`${event.order}: ${event.why}`, true);
  if (event.event === "line") tellLine(event.text);
  if (event.event === "end") live.end = event;
  if (!live.study) drawSoon();
}

const refillButtons = () => [...at("refills").querySelectorAll("button")];

/// A button for each [[refill]] of the case, which adds it before its time.
function showRefills(names) {
  at("refills").textContent = "";
  names.forEach(name => {
    const press = add(at("refills"), "button", `Refill ${name}`);
    Object.assign(press, {type: "button", value: name});
    press.addEventListener("click", tried(() => order(`refill ${name}`)));
  });
}

const kPictureAfter = 2000;  // ms between two pictures
async function livePicture(run) {
  if (live.run !== run || live.study) return;
  const begun = Date.now(), player = await ask(`/api/frame?${ofRun(run)}`);
  if (live.run === run && player) {
    const frames = player.frames;
    at("view-name").textContent = run;
    await showPicture(player, run);
    at("view-state").textContent = momentText(frames.time_s[0], frames.dose[0], frames.phase[0]);
  }
  if (live.run === run && player === null)
    at("view-state").textContent = "No picture of the run yet: it shows as soon as the run has a frame (frames.interval_s).";
  // The picture takes at most a quarter of the time.
  if (live.run === run && live.source) setTimeout(tried(livePicture), Math.max(kPictureAfter, 3 * (Date.now() - begun)), run);
}

/// Shows a run or the runs of a study: what its tables hold, then what it tells.
async function watch(run) {
  if (live.source) live.source.close();
  const {samples, doses, study} = await ask(`/api/history?${ofRun(run)}`);
  const before = samples.time_s.map((time_s, i) => ({time_s, dosed_mass_kg: samples.dosed_mass_kg[i], coil_torque_Nm: samples.coil_torque_Nm[i]}));
  const every = Math.ceil(before.length / kSamples);
  Object.assign(live, {run, samples: before.filter((_, i) => i % every === 0), doses, end: null, phase: "", expected: 0, filled: Infinity, first: null,
    study: study || live.studies.has(run), lines: []});
  at("live").hidden = false;
  at("live-name").textContent = run;
  at("live-state").textContent = "starting";
  ["order-state", "refills"].forEach(id => { at(id).textContent = ""; });
  ["charts", "told"].forEach(id => { at(id).textContent = ""; });
  at("charts").hidden = live.study;
  ["told", "members"].forEach(id => { at(id).hidden = true; });
  at("python").hidden = true;
  at("progress").value = 0;
  buttons(true);
  exportChoices();
  mark();
  live.source = new EventSource(`/api/events?${ofRun(run)}`);
  live.source.onmessage = message => take(JSON.parse(message.data));
  live.source.addEventListener("over", message => over(run, JSON.parse(message.data)));
  if (live.study) tried(showMembers)(run);
  else tried(livePicture)(run);
}

/// What a command said of its end, without how far it was before.
function lastWords(error) {
  const lines = error.split("\n").filter(l => l), own = lines.filter(l => l.startsWith("vkdose"));
  return (own.length > 0 ? own : lines.slice(-1)).map(l => l.replace(/^vkdose[^:]*: /, "")).join("; ");
}

function over(run, end) {
  live.source.close();
  live.source = null;
  const reason = live.end ? live.end.stop_sentence : end.known ? (end.code === 0 ? "done" : lastWords(end.error)) : "It does not run now.";
  at("live-state").textContent = reason || `ended with ${end.code}`;
  if (!live.study) drawRun();
  if (end.known && end.code === 0) at("progress").value = 1;
  buttons(false);
  document.documentElement.dataset.over = run;
  tried(list)();
  if (live.study) tried(showMembers)(run);
  else tried(livePicture)(run);
  // A study that was changed cannot go on in the folder of the former one.
  if (end.known && end.code !== 0 && /has changed since .* was begun/.test(end.error) && run.startsWith("out/") && open.name &&
      window.confirm(`${open.name} was changed since ${run} was begun. Run it into a folder beside that?`))
    tried(start)({beside: true});
}

function buttons(running) {
  at("stop").disabled = !running;
  at("resume").disabled = at("report").disabled = at("export").disabled = running;
  at("resume").hidden = live.study;  // a study goes on when it is run again
  at("orders").hidden = !running || live.study;
}

/// `how`: {force} replaces a former run, {beside} takes a folder that is free.
async function start(how) {
  const {force = false, beside = false} = how || {};
  if (at("text").value !== open.saved) await save();
  try {
    const {run} = await ask("/api/run", {name: open.name, force, beside});
    say("");
    if (at("plan").hidden === false) live.studies.add(run);
    await watch(run);
    at("live").scrollIntoView({block: "nearest"});
  } catch (error) {
    if (error.status !== 409 || force || !window.confirm(`${error.message}. Replace it?`)) throw error;
    await start({force: true});
  }
}

/// Has a file made and opens it.
async function openMade(what, path, body) {
  say(`making ${what}`);
  const {run, name} = await ask(path, body);
  say("");
  openFile(run, name);
}

const openFile = (run, name) => window.open(`/file?${ofRun(run)}&${about(name)}`, "_blank", "noopener");

const kPythonOf = run => {
  const name = open.name || "my.toml";
  return `import vkdose\n\ncase = vkdose.Case(${JSON.stringify(name)})\nresult = case.run(${JSON.stringify(run)}, force=True).wait()\nprint(result.doses)\n`;
};

const kPythonOfStudy = run => `import vkdose\n\nstudy = vkdose.SweepResult(${JSON.stringify(run)})\nprint(study.figures)\n`;

/// What can be taken out of a run: the label, and what is done.
const exportsOf = study => (study ? [
  ["members.csv", () => openFile(live.run, "members.csv")], ["figures.csv", () => openFile(live.run, "figures.csv")],
  ["calibrated.toml", () => openFile(live.run, "calibrated.toml")],
] : [
  ["picture", () => openMade("the picture", "/api/picture", {run: live.run})],
  ["film", () => openMade("the film", "/api/picture", {run: live.run, film: true})],
  ...["doses.csv", "timeseries.csv", "particles.csv", "summary.json", "case.toml"].map(name => [name, () => openFile(live.run, name)]),
]).concat([["Python lines", () => {
  at("python").hidden = false;
  at("python-text").textContent = study ? kPythonOfStudy(live.run) : kPythonOf(live.run);
  at("python-text").focus();
}]]);

function exportChoices() {
  const select = at("export");
  select.textContent = "";
  add(select, "option", "choose").value = "";
  exportsOf(live.study).forEach(([label]) => add(select, "option", label));
}

const order = text => ask("/api/order", {run: live.run, order: text}).then(() => { at("order-state").textContent = "ordered"; });

function beginRuns() {
  live.studies = new Set();
  at("run").addEventListener("click", tried(() => start()));
  at("stop").addEventListener("click", tried(() => ask("/api/stop", {run: live.run})));
  at("resume").addEventListener("click", tried(() => ask("/api/resume", {run: live.run}).then(() => watch(live.run))));
  at("report").addEventListener("click", tried(() => openMade("the report", "/api/report", {run: live.run})));
  at("export").addEventListener("change", tried(() => {
    const chosen = exportsOf(live.study).find(([label]) => label === at("export").value);
    at("export").value = "";
    return chosen && chosen[1]();
  }));
  at("orders").addEventListener("submit", tried(event => {
    event.preventDefault();
    return order(`speed ${at("speed").value.trim()}`);
  }));
  at("dose-to").addEventListener("click", tried(() => order(`dose ${at("dose").value.trim()}`)));
  at("drive-stop").addEventListener("click", tried(() => order("stop")));
  at("compare").addEventListener("click", tried(() => openMade("the comparison", "/api/compare", {runs: marked()})));
}
