// The folder: its cases, studies and runs; and how the page begins.

const markedRuns = new Set();
const marked = () => [...markedRuns].sort();

function entries(id, names, press, none) {
  const box = at(id);
  box.textContent = "";
  names.forEach(name => {
    const line = add(box, "li");
    if (id === "runs") line.appendChild(markFor(name));
    const entry = add(line, "button", name);
    entry.type = "button";
    entry.addEventListener("click", tried(() => press(name)));
  });
  if (names.length === 0 && none) add(box, "li", none);
}

/// The box by which runs are chosen to be shown beside each other.
function markFor(name) {
  const box = document.createElement("input");
  Object.assign(box, {type: "checkbox", checked: markedRuns.has(name)});
  box.setAttribute("aria-label", `compare ${name}`);
  box.addEventListener("change", () => {
    if (box.checked) markedRuns.add(name);
    else markedRuns.delete(name);
    at("compare").disabled = markedRuns.size < 2;
  });
  return box;
}

function mark() {
  const here = new Set([open.name, live.run]);
  document.querySelectorAll("nav li button").forEach(b => b.setAttribute("aria-current", here.has(b.textContent)));
}

async function list() {
  const found = await ask("/api/folder");
  at("folder").textContent = found.folder;
  entries("cases", found.cases, openCase, "none yet");
  entries("studies", found.studies, openCase, "none yet");
  entries("runs", found.runs, watch, found.sweeps.length > 0 ? null : "none yet");
  entries("sweeps", found.sweeps, watch, null);
  [...markedRuns].filter(name => !found.runs.includes(name)).forEach(name => markedRuns.delete(name));
  at("compare").hidden = found.runs.length < 2;
  at("compare").disabled = markedRuns.size < 2;
  mark();
  return found;
}

async function begin() {
  [beginCase, beginForm, beginPicture, beginRuns, beginStudies].forEach(part => part());
  const found = await list();
  const wanted = decodeURIComponent(location.hash.replace(/^#name=/, ""));
  const all = found.cases.concat(found.studies);
  const first = all.includes(wanted) ? wanted : all[0];
  at("start").hidden = Boolean(first);
  if (first) await openCase(first);
  const running = await ask("/api/running");
  if (running.length > 0) await watch(running[running.length - 1]);
  document.documentElement.dataset.state = "ready";
}

tried(begin)();
