"""What has been met so far, in a file that is written anew after every step: a second call goes on from it."""

import hashlib
import json
import os


def hash_of(path):
    """Of a program: what another one has met says nothing of this one."""
    with open(path, "rb") as f:
        return hashlib.sha256(f.read()).hexdigest()[:16]


class Memory:
    def __init__(self, out):
        self.path = os.path.join(out, "memory.json")
        self.all = {"cards": {}, "queue": {}, "log": []}
        try:
            with open(self.path, encoding="utf-8") as f:
                known = json.load(f)
            if isinstance(known, dict):
                self.all.update({k: v for k, v in known.items() if isinstance(v, type(self.all.get(k, {})))})
        except FileNotFoundError:
            pass
        except ValueError:
            os.replace(self.path, self.path + ".unreadable")
        self.card = {}

    def open_card(self, device, program):
        """What this program has met on this card."""
        cards = self.all["cards"].setdefault(device, {})
        self.card = cards.setdefault(program, {})
        for part in ("verify", "tests", "bench", "members"):
            self.card.setdefault(part, {})
        return self.card

    def save(self):
        with open(self.path + ".new", "w", encoding="utf-8") as f:
            json.dump(self.all, f, indent=1)
        os.replace(self.path + ".new", self.path)

    def rate(self):
        """The most particle-steps a second that this card has made with canisters in one ensemble; 0 if unknown."""
        rows = [r for r in self.card.get("members", {}).values() if isinstance(r, dict) and "rate" in r]
        return max((r["rate"] for r in rows), default=0.0)

    def note(self, text):
        print(text, flush=True)
        self.all["log"].append(text)
