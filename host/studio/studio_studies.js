// Studies: what they will run and what it costs, and their members as they end.

function showStudyPlan(found) {
  const lines = found.plan.trim() ? found.plan.trim().split("\n") : [];
  at("plan-text").textContent = lines.join("\n");
  at("view").hidden = true;
  verdict(found.error ? found.error.trim() : `A study: vkdose ${found.study}, ${lines.filter(l => l.startsWith("member")).length} runs planned.`,
    found.error ? "contradicts" : "matches");
  at("run").disabled = Boolean(found.error);
  const place = found.error.match(/\.toml:(\d+): /);
  numberLines(place ? [{kind: "error", line: Number(place[1]), file: ""}] : []);
}

const kLines = 500;  // of what a study tells, kept

/// A line of what the study tells; one of a member that has ended brings the table up to date.
function tellLine(text) {
  live.lines.push(text);
  live.lines.splice(0, live.lines.length - kLines);
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

async function showMembers(study) {
  const {columns, rows, of} = await ask(`/api/members?${ofRun(study)}`);
  if (live.run !== study) return;
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
  const planned = at("plan-text").textContent.split("\n").filter(l => l.startsWith("member")).length;
  if (live.source && planned > 0) at("progress").value = Math.min(1, of / planned);
  document.documentElement.dataset.members = String(of);
}
