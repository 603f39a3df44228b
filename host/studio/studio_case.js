// The case as text: checked while it is typed, undone, saved.

const open = {name: null, saved: null, checked: 0, past: [], future: [], left: new Map()};

const kCheckAfter = 350;  // ms without a key
let waiting = 0;

function numberLines(faults) {
  const marks = new Map();
  faults.forEach(f => { if (f.line > 0 && f.file === "" && marks.get(f.line) !== "b") marks.set(f.line, f.kind === "error" ? "b" : "i"); });
  const box = at("lines"), count = at("text").value.split("\n").length;
  box.textContent = "";
  for (let n = 1; n <= count; ++n) {
    if (marks.has(n)) add(box, marks.get(n), String(n));
    else box.appendChild(document.createTextNode(String(n)));
    box.appendChild(document.createTextNode("\n"));
  }
  box.scrollTop = at("text").scrollTop;
}

/// Puts the caret at a line, or at the line that has the key.
function goTo(fault) {
  const known = form.stated.find(s => s.key === fault.key);
  const line = fault.line || (known ? known.line : 0);
  if (!line) return;
  showAs(false);
  const lines = at("text").value.split("\n");
  const from = lines.slice(0, line - 1).reduce((sum, l) => sum + l.length + 1, 0);
  at("text").focus();
  at("text").setSelectionRange(from, from + lines[line - 1].length);
  at("text").scrollTop = (line - 4) * 13 * 1.45;
}

function showFaults(found) {
  const faults = found.errors.map(f => Object.assign({kind: "error"}, f))
    .concat(found.warnings.filter(w => !w.accepted).map(w => Object.assign({kind: "warning", line: 0, file: ""}, w)));
  const list = at("faults");
  list.textContent = "";
  faults.forEach(f => {
    const place = f.file ? `${f.file}:${f.line}: ` : f.line > 0 ? `line ${f.line}: ` : "";
    const entry = add(add(list, "li"), "button", `${place}${f.key ? f.key + (f.value ? " = " + f.value : "") + ": " : ""}${f.text}`, f.kind);
    entry.type = "button";
    if (f.cure) add(entry, "small", f.cure);
    entry.addEventListener("click", () => goTo(f));
  });
  const count = (n, what) => `${n} ${what}${n === 1 ? "" : "s"}`;
  const errors = found.errors.length, warnings = faults.length - errors;
  verdict(faults.length === 0 ? "The case can be run." : `${count(errors, "error")}, ${count(warnings, "warning")}`,
    errors > 0 ? "contradicts" : warnings > 0 ? "within" : "matches");
  at("run").disabled = errors > 0;
  numberLines(faults);
  return faults;
}

function verdict(text, kind) {
  at("verdict").textContent = text;
  at("verdict").className = kind;
}

const kFigures = [
  ["particles", "particles", x => String(x)], ["fill", "fill_kg", x => `${gramsText(x)} g`],
  ["time step", "time_step_s", x => `${short(1e6 * x)} µs`], ["steps", "steps", x => x.toLocaleString("en")],
  ["simulated time", "simulated_s", x => `${short(x)} s`], ["dose by the closed form", "dose_kg", x => `${gramsText(x)} g`],
  ["overlap under the bed", "overlap_under_bed", x => `${short(100 * x)} % of the radius`],
];

function showFigures(found) {
  const list = at("figures"), figures = found.figures;
  list.textContent = "";
  if (!figures) return;
  const rows = kFigures.filter(([, key]) => isNumber(figures[key])).map(([label, key, text]) => ({name: label, value: text(figures[key])}));
  factRows(list, rows);
  if (found.errors.length === 0 && found.run_time && isNumber(found.run_time.seconds))
    at("verdict").textContent += `${at("verdict").textContent.endsWith(".") ? "" : "."} A run takes about ${timeText(found.run_time.seconds)}.`;
}

const timeText = s => s < 90 ? `${Math.max(1, Math.round(s))} s` : s < 5400 ? `${Math.round(s / 60)} min` : `${(s / 3600).toFixed(1)} h`;

async function check() {
  const number = ++open.checked, name = open.name;
  const found = await ask("/api/check", {name, text: at("text").value});
  if (number !== open.checked || name !== open.name) return;  // another text has come meanwhile
  const done = () => { document.documentElement.dataset.checked = String(number); };
  at("law").hidden = !found.law;
  at("plan").hidden = !found.study;
  showNew();
  at("as-form").disabled = Boolean(found.law);
  if (found.law) at("faults").textContent = "";
  if (found.law) {
    at("law-name").textContent = found.law.file;
    at("law-text").textContent = found.law.text;
    verdict("The case waits for your word on its law.", "within");
    at("run").disabled = true;
    return done();
  }
  if (found.study) {
    await showStudyPlan(found);
    return done();
  }
  await showForm(found, showFaults(found), false);
  showFigures(found);
  if (found.scene) {
    at("view-name").textContent = "Before the run";
    at("view-state").textContent = "The powder as it is filled in, before it falls; colour is the radius.";
    await showPicture(found.scene, name);
  }
  done();
}

// ---- undo -----------------------------------------------------------------------------------------------------------

const kRemembered = 200;  // texts

/// Keeps the text as it was before a change. What is typed without a pause is one change.
function remember(text) {
  if (open.past.length > 0 && open.past[open.past.length - 1] === text) return;
  open.past.push(text);
  if (open.past.length > kRemembered) open.past.shift();
  open.future = [];
}

function turnBack(from, to) {
  if (from.length === 0) return;
  to.push(at("text").value);
  at("text").value = open.known = from.pop();
  afterChange();
}

/// A text that was not typed: from the form, or with a mesh.
function setText(text) {
  if (text === at("text").value) return;
  remember(at("text").value);
  at("text").value = open.known = text;
  afterChange();
}

function typed() {
  if (!open.typing) remember(open.known);
  open.typing = true;
  open.known = at("text").value;
  open.future = [];
  afterChange();
}

function showSteps() {
  at("save").disabled = at("text").value === open.saved;
  at("undo").disabled = open.past.length === 0;
  at("redo").disabled = open.future.length === 0;
}

function afterChange() {
  showSteps();
  numberLines([]);
  clearTimeout(waiting);
  waiting = setTimeout(tried(() => {
    open.typing = false;
    return check();
  }), kCheckAfter);
}

// ---- files ----------------------------------------------------------------------------------------------------------

async function openCase(name) {
  if (open.name && at("text").value !== open.saved && !window.confirm(`${open.name} has changes that are not saved. Drop them?`)) return;
  const {text} = await ask(`/api/case?${about(name)}`);
  if (open.name) open.left.set(open.name, {past: open.past, future: open.future, text: at("text").value});
  const before = open.left.get(name) || {past: [], future: [], text};
  Object.assign(open, {name, saved: text, known: text, past: before.past, future: before.future, typing: false});
  if (before.text !== text) remember(before.text);  // a text that was dropped, or changed by another program meanwhile
  at("text").value = text;
  at("case-name").textContent = name;
  at("case").hidden = false;
  at("start").hidden = true;
  showSteps();
  say("");
  mark();
  history.replaceState(null, "", `#${about(name)}`);
  await check();
}

async function save() {
  const text = at("text").value;
  await ask("/api/save", {name: open.name, text, before: open.saved});
  open.saved = text;
  at("save").disabled = true;
  say(`saved ${open.name}`);
  tried(list)();
}

async function make(event) {
  event.preventDefault();
  let name = at("new-name").value.trim();
  if (!name.endsWith(".toml")) name += ".toml";
  const answers = {};
  document.querySelectorAll("#new-canister input:enabled, #new-canister select:enabled").forEach(field => {
    if (field.value.trim()) answers[field.name] = field.value.trim();
  });
  await ask("/api/new", Object.assign(answers, {name, like: at("new-like").value, of: open.name || ""}));
  at("new-name").value = "";
  await list();
  await openCase(name);
}

const kStudies = ["sweep", "calibrate", "design"];

/// The figures of a powder are asked for unless it is one that is known.
function askFigures() {
  at("new-figures").hidden = at("new-figures").disabled = at("new-powder").value !== "";
}

async function listPowders() {
  const box = at("new-powder");
  if (box.options.length > 1) return;
  const known = await ask("/api/powders");
  if (box.options.length === 1) known.forEach(p => { add(box, "option", p.title).value = p.name; });
}

/// What is asked of a new case besides its name.
function showNew() {
  const like = at("new-like").value, study = kStudies.includes(like);
  at("new-canister").hidden = at("new-canister").disabled = like !== "canister";
  if (like === "canister") tried(listPowders)();
  at("new-of").hidden = !study;
  at("new-of").textContent = !study ? "" : open.name && at("plan").hidden ? `of ${open.name}` : "open the case first that it is to vary";
}

function beginCase() {
  at("text").addEventListener("input", typed);
  at("text").addEventListener("scroll", () => { at("lines").scrollTop = at("text").scrollTop; });
  at("save").addEventListener("click", tried(save));
  at("undo").addEventListener("click", () => turnBack(open.past, open.future));
  at("redo").addEventListener("click", () => turnBack(open.future, open.past));
  at("allow").addEventListener("click", tried(() => ask("/api/allow", {text: at("law-text").textContent}).then(check)));
  at("new").addEventListener("submit", tried(make));
  at("new-like").addEventListener("change", showNew);
  at("new-powder").addEventListener("change", askFigures);
  document.addEventListener("keydown", event => {
    if (!(event.ctrlKey || event.metaKey) || !open.name) return;
    const key = event.key.toLowerCase();
    // In a field of the form the browser undoes what is typed there.
    const inText = document.activeElement === at("text") || document.activeElement.tagName !== "INPUT";
    if (key === "s") tried(save)();
    else if (key === "enter" && !at("run").disabled) tried(start)();
    else if (inText && (key === "y" || (key === "z" && event.shiftKey))) turnBack(open.future, open.past);
    else if (inText && key === "z") turnBack(open.past, open.future);
    else return;
    event.preventDefault();
  });
  window.addEventListener("beforeunload", event => { if (open.name && at("text").value !== open.saved) event.preventDefault(); });
}
