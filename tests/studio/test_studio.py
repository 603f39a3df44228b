"""The workbench in a real browser: a case by its text, its faults, a run live, stopped and gone on with."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

try:
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import WebDriverWait
except ModuleNotFoundError:
    print("skipped: no Python module selenium (tools/packages-second-driver)")
    sys.exit(77)
if shutil.which("chromedriver") is None:
    print("skipped: no chromedriver (tools/packages-second-driver)")
    sys.exit(77)

FRAMES = "\n[frames]\ninterval_s = 0.02\n"
PATIENCE = 240  # s


def browser():
    options = webdriver.ChromeOptions()
    # The machine may have no graphics, and the test may run as root in a container.
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader",
                 "--enable-unsafe-swiftshader", "--window-size=1366,900"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options)


class Workbench(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        text = (ROOT / "cases" / "mini.toml").read_text()
        (self.folder / "my.toml").write_text(text + FRAMES)
        self.studio = subprocess.Popen([os.environ["VKDOSE"], "studio", folder.name], stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end)
        self.studio.stdout.readline()
        self.address = self.studio.stdout.readline().split()[1]
        self.page = browser()
        self.addCleanup(self.page.quit)
        self.page.get(self.address)
        self.until(lambda: self.data("state") == "ready")

    def end(self):
        self.studio.send_signal(signal.SIGINT)
        self.assertEqual(self.studio.wait(60), 0)
        self.studio.stdout.close()

    def until(self, what):
        WebDriverWait(self.page, PATIENCE).until(lambda _: what())

    def data(self, name):
        return self.page.execute_script("return document.documentElement.dataset[arguments[0]]", name)

    def at(self, name):
        return self.page.find_element(By.ID, name)

    def type(self, change):
        """Changes the text as somebody who types, and waits until it has been checked."""
        before = int(self.data("checked") or 0)
        self.page.execute_script(
            "const t = document.getElementById('text'); t.value = t.value.replace(arguments[0], arguments[1]);"
            "t.dispatchEvent(new Event('input'))", *change)
        self.until(lambda: int(self.data("checked")) > before)

    def over(self):
        self.until(lambda: self.data("over") == "out/my")
        self.page.execute_script("delete document.documentElement.dataset.over")

    def test_a_case_from_a_fault_to_its_doses(self):
        self.assertNotIn("token", self.page.current_url)
        self.assertEqual(self.at("verdict").text, "The case can be run.")
        self.assertEqual(self.data("picture"), "my.toml")
        self.assertIn("111", self.at("figures").text)

        self.type(["mass_g = 0.9", "mass_g = -3"])
        self.assertEqual(self.at("verdict").text, "1 error, 0 warnings")
        self.assertIn("line 11: particles.mass_g = -3", self.at("faults").text)
        self.assertFalse(self.at("run").is_enabled())
        self.page.find_element(By.CSS_SELECTOR, "#faults button").click()
        marked = "const t = document.getElementById('text'); return t.value.slice(t.selectionStart, t.selectionEnd)"
        self.assertEqual(self.page.execute_script(marked), "mass_g = -3")
        self.type(["mass_g = -3", "mass_g = 0.9  # mended"])
        self.assertEqual(self.at("verdict").text, "The case can be run.")

        # By keyboard alone: saved, run, and stopped in its second dose.
        self.at("text").send_keys(Keys.CONTROL, "s")
        self.until(lambda: self.at("message").text == "saved my.toml")
        self.assertIn("# mended", (self.folder / "my.toml").read_text())
        self.at("text").send_keys(Keys.CONTROL, Keys.ENTER)
        self.until(lambda: "dose 1" in self.at("live-state").text)
        self.at("stop").send_keys(Keys.ENTER)
        self.over()
        self.assertIn("interrupted", self.at("live-state").text)
        self.at("resume").send_keys(Keys.ENTER)
        self.over()
        self.assertEqual(self.at("live-state").text, "the 2 doses asked for are done")
        titles = [t.text for t in self.page.find_elements(By.CSS_SELECTOR, "#charts h3")]
        self.assertEqual(titles, ["Cumulative dosed mass", "Mass per dose", "Dosed mass", "Torque of the coil"])
        # Both doses, though the first one came before the stop.
        dots = self.page.find_elements(By.CSS_SELECTOR, "#charts figure:nth-child(2) g[clip-path] circle")
        self.assertEqual(len(dots), 2)
        self.until(lambda: self.data("picture") == "out/my")
        self.assertEqual(len((self.folder / "out/my/doses.csv").read_text().splitlines()), 3)

        # A page that comes later finds the run.
        self.page.get(self.address)
        self.until(lambda: self.data("state") == "ready")
        runs = self.page.find_elements(By.CSS_SELECTOR, "#runs button")
        self.assertEqual([r.text for r in runs], ["out/my"])

        for width in (390, 1366):
            self.page.set_window_size(width, 844)
            fits = "return document.documentElement.scrollWidth <= window.innerWidth"
            self.until(lambda: self.page.execute_script(fits))
        colours = []
        for scheme in ("light", "dark"):
            self.page.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                      {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
            colours.append(self.page.execute_script("return getComputedStyle(document.body).backgroundColor"))
        self.assertNotEqual(*colours)
        faults = [line["message"] for line in self.page.get_log("browser") if line["level"] == "SEVERE"]
        self.assertEqual(faults, [])


if __name__ == "__main__":
    try:
        browser().quit()
    except WebDriverException as lack:
        print(f"skipped: Chromium does not start: {lack.msg}")
        sys.exit(77)
    unittest.main()
