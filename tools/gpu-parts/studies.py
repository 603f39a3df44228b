"""Runs the studies of the queue for as long as there is time."""

import os

import queue_file


def queue(s, path, seconds, rate, least=20.0):
    """Takes from the top of the queue. `rate`: particle-steps/s. A study that is not whole when its time is up goes on
    in the next call. `least`: no study begins with fewer seconds than these."""
    part = s.deadline.part(seconds)
    known = s.memory.all["queue"]
    try:
        studies = queue_file.read(path)
    except (OSError, queue_file.QueueError) as error:
        s.memory.note(f"the queue is left out: {error}")
        return
    tried = set()
    while part.left() >= least:
        left = {name: k["left_G"] for name, k in known.items() if "left_G" in k}
        study, whole = queue_file.chosen([e for e in studies if e["name"] not in tried], left, rate, part.left())
        if study is None:
            break
        name = study["name"]
        words = [study["command"], study["file"], "--out", os.path.join(s.out, "studies", name),
                 "--for", f"{max(1.0, part.left() - 5):.0f}s", *s.device]
        s.memory.note(f"queue: {study['study']}, {left.get(name, study['cost_G']):.4g} G particle-steps, "
                      f"{'fits' if whole else 'begins or goes on'} at {rate / 1e6:.4g} M/s")
        ended = s.vkdose("queue " + name, words, part.left() + 30)
        entry = known.setdefault(name, {})
        if ended.code in (0, 1) and not ended.overran:  # every member has ended
            entry.update(state="done", left_G=0.0)
            s.memory.note(f"queue: {study['study']} is done" +
                          (", but not all is well: see its log" if ended.code == 1 else ""))
        else:
            rest = queue_file.members_left(ended.text)
            entry["state"] = "begun"
            if rest is not None:
                entry["left_G"] = rest
            if ended.code != 6:
                tried.add(name)  # it would only fail again
                entry["why"] = ended.words()
                s.memory.note(f"queue: {study['study']}: {ended.words()}")
        s.memory.save()
