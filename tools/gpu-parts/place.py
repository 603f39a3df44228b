"""Where the programs and the files that they need are: in a folder that was packed to be carried, or in the project's
folder where it was built."""

import glob
import json
import os
import shutil

ROOMS = ["pass", "scene", "render", "device"]  # whose tests judge what a device computes
NVIDIA = "libGLX_nvidia.so.0"
LOADER = "libvulkan.so.1"
# Libraries that a bare machine may lack, with Debian's packages: the Vulkan loader, and what NVIDIA's driver loads. Without
# them the driver is found and says no more than that it does not start.
DRIVER_NEEDS = {LOADER: "libvulkan1", "libGLdispatch.so.0": "libglvnd0", "libX11.so.6": "libx11-6",
                "libXext.so.6": "libxext6"}


class Place:
    def __init__(self, root, program=None):
        self.root = root
        self.packed = os.path.isfile(os.path.join(root, "bin", "vkdose"))
        bins = os.path.join(root, "bin") if self.packed else os.path.join(root, "build", "release")
        self.program = program or os.path.join(bins, "vkdose")
        self.tests = bins if self.packed else os.path.join(bins, "tests")
        self.libraries = os.path.join(root, "lib")

    def test(self, room):
        return os.path.join(self.tests, "test_" + room)

    def environment(self, out):
        """Of every program that is run. The libraries that were packed come behind those that the user names."""
        env = dict(os.environ)
        if self.packed:
            paths = [env["LD_LIBRARY_PATH"]] if env.get("LD_LIBRARY_PATH") else []
            env["LD_LIBRARY_PATH"] = ":".join(paths + [self.libraries])
        env["VKDOSE_TEST_SOURCE"] = self.root
        env["VKDOSE_TEST_PROGRAM"] = self.program
        env["NODEVICE_SELECT"] = "1"
        if not validation_layer():
            env["VKDOSE_TEST_UNVALIDATED"] = "1"
        manifest = nvidia_manifest(env, out)
        if manifest:
            env["VK_ICD_FILENAMES"] = manifest
        return env


def _files(kind):
    """The files of drivers (icd.d) or layers (explicit_layer.d) that the Vulkan loader finds."""
    places = ["/etc/vulkan", "/usr/share/vulkan", "/usr/local/share/vulkan", "/usr/local/etc/vulkan"]
    return sorted(file for place in places for file in glob.glob(f"{place}/{kind}/*.json"))


def validation_layer():
    return any("khronos_validation" in file for file in _files("explicit_layer.d"))


def library(name):
    """The path of a shared library of the machine; None if there is none."""
    places = [p for p in os.environ.get("LD_LIBRARY_PATH", "").split(":") if p]
    places += ["/usr/lib/x86_64-linux-gnu", "/usr/lib64", "/usr/lib", "/usr/lib/aarch64-linux-gnu",
               "/usr/local/nvidia/lib64", "/usr/local/nvidia/lib", "/lib64", "/lib/x86_64-linux-gnu"]
    return next((os.path.join(p, name) for p in places if os.path.exists(os.path.join(p, name))), None)


def nvidia_manifest(env, out):
    """A container often has NVIDIA's driver, but not the file by which the Vulkan loader finds it. Then one is
    written. None if it is not needed, or if the user names a driver."""
    if env.get("VK_ICD_FILENAMES") or env.get("VK_DRIVER_FILES"):
        return None
    driver = library(NVIDIA)
    if driver is None or any("nvidia" in file for file in _files("icd.d")):
        return None
    os.makedirs(out, exist_ok=True)
    file = os.path.join(out, "nvidia_icd.json")
    with open(file, "w", encoding="utf-8") as f:
        json.dump({"file_format_version": "1.0.0", "ICD": {"library_path": driver, "api_version": "1.3.0"}}, f)
    return file


def tools_missing(place):
    """What of the programs is not there, each with what would bring it."""
    missing = []
    if not os.path.isfile(place.program):
        missing.append(f"{place.program}: build it with tools/build release, or carry a folder made by --pack")
    missing += [f"{place.test(room)}: its tests are left out" for room in ROOMS
                if not os.path.isfile(place.test(room))]
    for name, package in DRIVER_NEEDS.items():
        carried = os.path.exists(os.path.join(place.libraries, name))
        if (name == LOADER or library(NVIDIA)) and library(name) is None and not carried:
            missing.append(f"{name}: Debian's package {package}")
    return missing
