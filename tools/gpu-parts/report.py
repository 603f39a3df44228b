"""The table that is sent back, written anew after every part."""

import os


def _count(values, what):
    return sum(1 for v in values if v == what)


def lines(memory, device, missing):
    card = memory.card
    text = [f"# What {device} did", ""]
    text += [f"- missing: {m}" for m in missing]
    met = card.get("verify", {})
    known, good = sum(v["known"] for v in met.values()), sum(v["met"] for v in met.values())
    failed = sorted(n for n, v in met.items() if v["failed"])
    text += [f"- `verify`: {good} of {known} known answers met in {len(met)} of {card.get('verify_cases', '?')} cases" +
             (f"; not met: {', '.join(failed)}" if failed else "")]
    tests = card.get("tests", {})
    bad = sorted(n for n, v in tests.items() if v == "failed")
    text += [f"- tests of what a device computes: {_count(tests.values(), 'passed')} of {card.get('tests_all', '?')} "
             f"passed, {_count(tests.values(), 'skipped')} skipped, {len(bad)} failed"]
    text += [f"    - failed: {name}" for name in bad]
    for title, part, unit in [("One canister", "bench", "bed"), ("Canisters in one ensemble", "members", "canisters")]:
        rows = card.get(part, {})
        if not rows:
            continue
        text += ["", f"## {title}", "", f"| {unit} | spheres | M particle-steps/s | from | to |",
                 "| --- | --- | --- | --- | --- |"]
        for key, r in rows.items():
            if "rate" in r:
                text += [f"| {key} | {r['particles']} | {r['rate'] / 1e6:.4g} | {r['low'] / 1e6:.4g} | "
                         f"{r['high'] / 1e6:.4g} |"]
            else:
                text += [f"| {key} | | {r.get('refused') or r.get('failed')} | | |"]
    if memory.all["queue"]:
        text += ["", "## Studies", "", "| study | state | G particle-steps left |", "| --- | --- | --- |"]
        text += [f"| {name} | {k.get('state', '?')}{': ' + k['why'] if k.get('why') else ''} | {k.get('left_G', '?')} |"
                 for name, k in memory.all["queue"].items()]
    return text


def write(memory, out, device, missing):
    with open(os.path.join(out, "gpu-minutes.md"), "w", encoding="utf-8") as f:
        f.write("\n".join(lines(memory, device, missing)) + "\n")
    rows = memory.card.get("members", {})
    with open(os.path.join(out, "bench-members.csv"), "w", encoding="utf-8") as f:
        f.write("members,particles,particle_steps_per_s,particle_steps_per_s_low,particle_steps_per_s_high,"
                "table_bytes_per_particle,refused\n")
        for number, r in rows.items():
            if "rate" in r:
                f.write(f"{number},{r['particles']},{r['rate']},{r['low']},{r['high']},{r['bytes']},\n")
            elif "refused" in r:
                f.write(f"{number},,,,,,\"{r['refused']}\"\n")
