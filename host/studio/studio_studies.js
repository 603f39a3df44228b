// Studies: what they will run and what it costs, and their members as they end.

async function showStudyPlan(found) {
  const lines = found.plan.trim() ? found.plan.trim().split("\n") : [];
  at("plan-text").textContent = lines.join("\n");
  at("view").hidden = true;
  await showForm(found, showFaults({errors: found.error.trim().split("\n").filter(l => l).map(l => faultOf(l, open.name)), warnings: []}), true);
  const cost = lines.find(l => l.startsWith("run time"));
  if (!found.error) verdict(`A study: vkdose ${found.study}, ${lines.filter(l => l.startsWith("member")).length} runs planned${cost ? `; ${cost}` : ""}.`, "matches");
}

/// A line that the program has told of a fault: FILE:LINE: KEY: what is wrong; what would be right.
function faultOf(text, name) {
  const parts = text.match(/^(.*\.toml):(\d+): (?:([\w.[\]"-]+)(?: = (.*?))?: )?(.*)$/);
  if (!parts) return {line: 0, file: "", key: "", value: "", text, cure: ""};
  const [, file, line, key, value, rest] = parts, [problem, ...cure] = rest.split("; ");
  const own = file === name || file.endsWith(`/${name}`) || !file.includes("/") && name.endsWith(`/${file}`);
  return {line: Number(line), file: own ? "" : file, key: key || "", value: value || "", text: problem, cure: cure.join("; ")};
}

const kLines = 500;  // of what a study tells, kept

/// A line of what the study tells; one of a member that has ended brings the table up to date.
function tellLine(text) {
  live.lines.push(text);
  live.lines.splice(0, live.lines.length - kLines);
  at("told").hidden = false;
  at("told").textContent = live.lines.join("\n");
  at("told").scrollTop = at("told").scrollHeight;
  at("live-state").textContent = text;
  live.membersDue = live.membersDue || setTimeout(tried(() => {
    live.membersDue = 0;
    return live.study ? showMembers(live.run) : undefined;
  }), 500);
}

/// Columns that are the same for all members tell nothing, but for these.
const kAlways = new Set(["member", "seed", "status"]);

const kDoseFigures = ["mean_dose_kg", "dose.mean_kg"];  // while it goes on, and once it is over

/// Members as points: one column across, another one up.
function memberChart({columns, keys, rows}) {
  const numbers = columns.map((name, i) => i).filter(i => rows.some(r => r[i] !== "" && isNumber(Number(r[i]))));
  const varied = numbers.filter(i => !kAlways.has(columns[i]) && new Set(rows.map(r => r[i])).size > 1);
  const figures = varied.filter(i => !keys.includes(columns[i])), dose = figures.find(i => kDoseFigures.includes(columns[i]));
  const usual = {"member-x": varied.find(i => keys.includes(columns[i])) ?? columns.indexOf("member"), "member-y": dose ?? figures[0]};
  ["member-x", "member-y"].forEach(id => {
    const select = at(id), before = select.value;
    select.textContent = "";
    numbers.forEach(i => { add(select, "option", columns[i]); });
    select.value = numbers.some(i => columns[i] === before) && live.axes === live.run ? before : columns[usual[id]] ?? "";
  });
  const [x, y] = ["member-x", "member-y"].map(id => columns.indexOf(at(id).value)), box = at("member-chart");
  box.textContent = "";
  drawings.length = 0;
  if (x < 0 || y < 0) return;
  const number = text => (text === "" ? NaN : Number(text));
  const points = rows.map(r => [number(r[x]), number(r[y])]).filter(p => p.every(isNumber));
  chart(box, {title: `${columns[y]} by ${columns[x]}`, x: {label: columns[x], pad: true}, y: {label: columns[y], zero: false},
    series: [{name: columns[y], unnamed: true, colour: "var(--s0)", dots: true, line: false, points}]});
  drawings.forEach(again => again());
}

/// How many runs the study has at most; a search ends sooner if it can.
function mostRuns() {
  const plan = at("plan-text").textContent, most = plan.match(/at most (\d+) members/);
  return most ? Number(most[1]) : plan.split("\n").filter(l => l.startsWith("member")).length;
}

/// Before a member has ended there is nothing to show, and nothing by which to tell how long it takes. The table lacks the
/// runs that confirm a point; what the study tells has them.
function tellMembers(inTable) {
  at("members").hidden = live.table.rows.length === 0;
  if (!live.source) return;
  const ended = Math.max(inTable, live.lines.filter(l => /^member \d+ .* (ok|failed): /.test(l)).length);
  const most = mostRuns(), now = Date.now();
  if (most > 0) at("progress").value = Math.min(1, ended / most);
  if (ended === 0 && live.lines.length === 0) at("live-state").textContent = "no run of the study has ended yet";
  if (!live.first || live.first.ended > ended) live.first = {ended, now};
  const made = ended - live.first.ended, rest = most - ended;
  if (made > 0 && rest > 0)
    at("live-state").textContent = `${ended} of at most ${most} runs have ended, at most about ${timeText(rest * (now - live.first.now) / made / 1000)} left`;
}

async function showMembers(study) {
  live.table = await ask(`/api/members?${ofRun(study)}`);
  if (live.run !== study) return;
  memberChart(live.table);
  const {columns, rows, ended} = live.table;
  const kept = columns.map((name, i) => i).filter(i => kAlways.has(columns[i]) || new Set(rows.map(r => r[i])).size > 1);
  const [head, body] = [at("members").querySelector("thead"), at("members").querySelector("tbody")];
  head.textContent = body.textContent = "";
  const heads = add(head, "tr");
  kept.forEach(i => add(heads, "th", columns[i]));
  rows.forEach(row => {
    const line = add(body, "tr");
    kept.forEach(i => {
      if (columns[i] !== "member") return add(line, "td", row[i] !== "" && isNumber(Number(row[i])) ? short(Number(row[i])) : row[i]);
      const go = add(add(line, "td"), "button", row[i]);
      go.type = "button";
      go.addEventListener("click", tried(() => watch(`${study}/members/${row[i].padStart(4, "0")}`)));
      return go;
    });
  });
  tellMembers(ended);
  document.documentElement.dataset.members = String(ended);
}

function beginStudies() {
  at("member-axes").addEventListener("change", () => {
    live.axes = live.run;  // from now on its user's choice
    memberChart(live.table);
  });
}
