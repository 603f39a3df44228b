"""The workbench in a real browser: a case by its text, its faults, a run live, stopped and gone on with."""

import json
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
    from selenium.common.exceptions import StaleElementReferenceException, WebDriverException
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ModuleNotFoundError:
    print("skipped: no Python module selenium (tools/packages-second-driver)")
    sys.exit(77)
if shutil.which("chromedriver") is None:
    print("skipped: no chromedriver (tools/packages-second-driver)")
    sys.exit(77)

FRAMES = "\n[frames]\ninterval_s = 0.02\n"
STUDY = """base = "my.toml"
[set]
"settle.time_s" = 0.05
"dose.rotate_s" = 0.1
"stop.max_doses" = 1
[[axis]]
key = "contact.friction"
values = [0.3, 0.5]
"""
SPOON = """
[[refill]]
name = "spoon"
mass_g = 0.1
"""
PATIENCE = 240  # s


def browser():
    options = webdriver.ChromeOptions()
    # The machine may have no graphics, and the test may run as root in a container.
    for word in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader",
                 "--enable-unsafe-swiftshader", "--window-size=1366,900"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options)


def as_ply(obj):
    """The corners and triangles of an OBJ as the text of a PLY."""
    lines = [line.split() for line in obj.splitlines()]
    corners = [" ".join(line[1:]) for line in lines if line[0] == "v"]
    faces = ["3 " + " ".join(str(int(i) - 1) for i in line[1:]) for line in lines if line[0] == "f"]
    return (f"ply\nformat ascii 1.0\nelement vertex {len(corners)}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
            + "\n".join(corners + faces) + "\n")


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

    def press(self, selector):
        """Clicks what a list has; the page may make the list anew meanwhile."""
        def pressed():
            try:
                self.page.find_element(By.CSS_SELECTOR, selector).click()
                return True
            except StaleElementReferenceException:
                return False
        self.until(pressed)

    def type(self, change):
        """Changes the text as somebody who types, and waits until it has been checked."""
        before = int(self.data("checked") or 0)
        self.page.execute_script(
            "const t = document.getElementById('text'); t.value = t.value.replace(arguments[0], arguments[1]);"
            "t.dispatchEvent(new Event('input'))", *change)
        self.until(lambda: int(self.data("checked")) > before)

    def text(self):
        return self.page.execute_script("return document.getElementById('text').value")

    def over(self):
        self.until(lambda: self.data("over") == "out/my")
        self.page.execute_script("delete document.documentElement.dataset.over")

    def test_a_case_from_a_fault_to_its_doses(self):
        self.assertNotIn("token", self.page.current_url)
        self.assertRegex(self.at("verdict").text, r"^The case can be run\. A run takes about \d+ s\.$")
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
        self.assertIn("The case can be run.", self.at("verdict").text)

        # By keyboard alone: saved, run, and stopped in its second dose.
        self.at("text").send_keys(Keys.CONTROL, "s")
        self.until(lambda: self.at("message").text == "saved my.toml")
        self.assertIn("# mended", (self.folder / "my.toml").read_text())
        self.at("text").send_keys(Keys.CONTROL, Keys.ENTER)
        self.until(lambda: "dose 1" in self.at("live-state").text)
        self.until(lambda: float(self.at("progress").get_attribute("value")) > 0)
        self.assertEqual([r.text for r in self.page.find_elements(By.CSS_SELECTOR, "#runs button")], ["out/my"])
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


    def test_a_form_is_the_text_in_another_view(self):
        self.at("as-form").click()
        self.until(lambda: self.page.find_elements(By.CSS_SELECTOR, "#form-groups details"))
        self.at("form-find").send_keys("friction")
        field = self.at("key-contact.wall.friction")
        self.assertEqual(field.get_attribute("value"), "0.2")
        self.assertIn("a coefficient, not an angle", self.at("key-contact.wall.friction-meaning").text)
        before = self.text()
        checked = int(self.data("checked"))
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys("0.31", Keys.ENTER)
        self.until(lambda: int(self.data("checked")) > checked)
        self.assertEqual(self.text(), before.replace("[contact.wall]\nfriction = 0.2", "[contact.wall]\nfriction = 0.31"))
        # A key that is not stated gets a line of its own; a wrong value is told beside it.
        checked = int(self.data("checked"))
        field = self.at("key-contact.coil.friction")
        field.send_keys("-1", Keys.ENTER)
        self.until(lambda: int(self.data("checked")) > checked)
        self.assertIn("[contact.coil]\nfriction = -1", self.text())
        self.until(lambda: self.page.find_elements(By.CSS_SELECTOR, ".key.error #key-contact\\.coil\\.friction"))
        self.assertFalse(self.at("run").is_enabled())
        for _ in range(2):
            self.at("undo").click()
        self.assertEqual(self.text(), before)
        self.at("redo").click()
        self.assertIn("friction = 0.31", self.text())

    def test_a_mesh_becomes_a_body_and_the_motion_is_played(self):
        facets = "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 5\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
        outside = tempfile.TemporaryDirectory()
        self.addCleanup(outside.cleanup)
        (Path(outside.name) / "blade.obj").write_text(facets)
        self.until(lambda: self.data("checked"))
        self.at("mesh").send_keys(str(Path(outside.name) / "blade.obj"))
        self.until(lambda: self.at("mesh-unit").is_displayed())
        self.assertIn("4 triangles, closed", self.at("mesh-facts").text)
        self.assertIn("mm: 2 \u00d7 3 \u00d7 5 mm", self.at("mesh-choice").text)
        checked = int(self.data("checked"))
        self.at("mesh-unit").find_element(By.TAG_NAME, "button").click()
        self.until(lambda: int(self.data("checked")) > checked)
        self.assertIn('[[body]]\nname = "blade"\nmesh = "blade.obj"\nunit = "mm"\n', self.text())
        self.until(lambda: self.page.execute_script("return picture.scene.bodies.map(b => b.name)") == ["blade"])
        # Another one is dropped with the mouse; it gets a name of its own.
        self.page.execute_script(
            "const files = new DataTransfer(); files.items.add(new File([arguments[0]], 'blade.ply'));"
            "document.getElementById('view').dispatchEvent("
            "new DragEvent('drop', {dataTransfer: files, bubbles: true, cancelable: true}))", as_ply(facets))
        self.until(lambda: self.at("mesh-unit").is_displayed() and self.at("mesh-name").text == "blade.ply")
        self.at("mesh-unit").find_element(By.TAG_NAME, "button").click()
        self.until(lambda: 'name = "blade-2"\nmesh = "blade.ply"' in self.text())
        self.until(lambda: "coincides with body" in self.at("faults").text)
        self.at("undo").click()
        self.until(lambda: "can be run" in self.at("verdict").text)
        turned = "return picture.scene.coil.rotation.z"
        self.assertEqual(self.page.execute_script(turned), 0)
        self.at("play").click()
        self.until(lambda: int(self.data("moment") or 0) > 5)
        self.assertNotEqual(self.page.execute_script(turned), 0)

    def test_a_run_is_ordered_about_compared_and_exported(self):
        with open(self.folder / "my.toml", "a") as case:
            case.write(SPOON)
        self.page.refresh()
        self.until(lambda: self.data("state") == "ready")
        self.at("run").click()
        self.press("#refills button")
        # It is added once, and its button says so.
        self.until(lambda: self.page.find_elements(By.CSS_SELECTOR, "#refills button:disabled"))
        self.until(lambda: "dose 1" in self.at("live-state").text)
        self.at("speed").send_keys("60", Keys.ENTER)
        self.until(lambda: "60 rpm from" in self.at("order-state").text)
        self.over()
        summary = json.loads((self.folder / "out/my/summary.json").read_text())
        self.assertEqual([o["order"] for o in summary["orders"]], ["speed"])
        self.assertIsNotNone(summary["refills"][0]["time_s"])
        shutil.copytree(self.folder / "out/my", self.folder / "out/other")
        self.page.refresh()
        self.until(lambda: self.data("state") == "ready")
        self.assertFalse(self.at("compare").is_enabled())
        for box in self.page.find_elements(By.CSS_SELECTOR, "#runs input"):
            box.click()
        self.at("compare").click()
        self.until(lambda: len(self.page.window_handles) == 2)
        self.page.switch_to.window(self.page.window_handles[1])
        self.until(lambda: "out/other" in self.page.page_source or "other" in self.page.title)
        self.page.close()
        self.page.switch_to.window(self.page.window_handles[0])
        self.page.find_element(By.CSS_SELECTOR, "#runs button").click()
        self.until(lambda: "Python lines" in self.at("export").text)
        self.over()
        self.page.execute_script("const e = document.getElementById('export'); e.value = 'Python lines'; e.dispatchEvent(new Event('change'))")
        self.until(lambda: "vkdose.Case" in self.at("python-text").text)
        if shutil.which("ffmpeg"):
            Select(self.at("export")).select_by_visible_text("film")
            self.until((self.folder / "out/my/film.mp4").exists)

    def test_a_new_device_and_a_study_over_it(self):
        def make(like, name, **answers):
            Select(self.at("new-like")).select_by_value(like)
            for key, value in answers.items():
                self.page.find_element(By.NAME, key).send_keys(value)
            self.at("new-name").clear()
            self.at("new-name").send_keys(name, Keys.ENTER)
            self.until(lambda: self.at("case-name").text == f"{name}.toml")

        # A powder that is known needs no figures.
        Select(self.at("new-like")).select_by_value("canister")
        powder = Select(self.at("new-powder"))
        self.until(lambda: len(powder.options) > 3)
        density = self.page.find_element(By.NAME, "bulk-density")
        self.assertTrue(density.is_displayed())
        powder.select_by_value("millet")
        self.assertFalse(density.is_displayed())
        powder.select_by_value("")
        make("canister", "tiny", canister="16x14x40mm", coil="3x6mm", fill="1g")
        self.until(lambda: "A run takes about" in self.at("verdict").text)
        self.assertIn("mass_g = 1 ", self.text())
        make("tray", "tray")
        self.until(lambda: self.page.execute_script("return picture.scene ? picture.scene.bodies.length : 0") > 0)
        # A name that is taken replaces nothing.
        self.at("new-name").send_keys("tray", Keys.ENTER)
        self.until(lambda: "is there already" in self.at("message").text)
        make("sweep", "study")
        self.until(lambda: "6 runs planned" in self.at("verdict").text)
        self.assertIn('base = "tray.toml"', self.text())
        self.at("as-form").click()
        self.until(lambda: self.page.find_elements(By.ID, "key-axis[0].values"))
        values = self.at("key-axis[0].values")
        values.send_keys(Keys.CONTROL, "a")
        values.send_keys("[0.4]", Keys.ENTER)
        self.until(lambda: "2 runs planned" in self.at("verdict").text)
        seeds = self.at("key-seeds")
        seeds.send_keys(Keys.CONTROL, "a")
        seeds.send_keys("[1, 1]", Keys.ENTER)
        self.until(lambda: self.page.find_elements(By.CSS_SELECTOR, ".key.error #key-seeds"))
        # What was undone stays so while another case is looked at.
        self.at("undo").click()
        self.until(lambda: "2 runs planned" in self.at("verdict").text)
        self.at("save").click()
        self.until(lambda: "saved" in self.at("message").text)
        self.press("#cases button")
        self.until(lambda: self.at("case-name").text == "my.toml")
        self.press("#studies button")
        self.until(lambda: self.at("case-name").text == "study.toml")
        self.at("redo").click()
        self.assertIn("[1, 1]", self.text())

    def test_a_study_from_its_plan_to_a_member(self):
        (self.folder / "study.toml").write_text(STUDY)
        self.page.refresh()
        self.until(lambda: self.data("state") == "ready")
        self.page.find_element(By.CSS_SELECTOR, "#studies button").click()
        self.until(lambda: "2 runs planned" in self.at("verdict").text)
        self.assertIn("contact.friction 0.5", self.at("plan-text").text)
        self.at("run").click()
        self.assertFalse(self.at("member-x").is_displayed())  # before a member has ended there are no axes to choose
        self.until(lambda: self.data("over") == "out/study")
        self.assertEqual(self.at("live-state").text, "done")
        self.until(lambda: self.data("members") == "2")
        self.assertEqual(len(self.page.find_elements(By.CSS_SELECTOR, "#member-chart circle")), 2)
        Select(self.at("member-y")).select_by_visible_text("rate.window_s")
        self.until(lambda: "rate.window_s by contact.friction" in self.at("member-chart").text)
        self.page.find_elements(By.CSS_SELECTOR, "#members td button")[1].click()
        self.until(lambda: self.at("live-name").text == "out/study/members/0001")
        self.until(lambda: self.page.find_elements(By.CSS_SELECTOR, "#charts h3"))


if __name__ == "__main__":
    try:
        browser().quit()
    except WebDriverException as lack:
        print(f"skipped: Chromium does not start: {lack.msg}")
        sys.exit(77)
    unittest.main()
