// vkdose._core: Simulation for Python. What it says to a user stands in simulation.py, which is all that uses it. The
// library is pybind11; only this file and arrays.h know it.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "host/backend/vulkan/law_trial.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/key.h"
#include "host/core/memory_limit.h"
#include "host/model/powders.h"
#include "host/output/frame_files.h"
#include "host/output/run_folder.h"
#include "host/play/backend_choice.h"
#include "host/play/simulation.h"
#include "host/python/arrays.h"

namespace py = pybind11;
using namespace vkdose;

namespace {

/// How long Ctrl-C may wait at most. The run itself may take a second until it rests, so a shorter time would only
/// cost.
constexpr std::chrono::milliseconds kLookEvery(200);

/// How long a thread that has been told to return may take to do so before it is looked at again.
constexpr std::chrono::milliseconds kMoment(5);

/// The package's exception of this name, with `arguments`.
template <class... A>
void raise(const char* name, const A&... arguments) {
    const py::object type = py::module_::import("vkdose.errors").attr(name);
    PyErr_SetObject(type.ptr(), type(arguments...).ptr());
}

py::tuple faultsOf(const CaseError& error) {
    const py::object fault = py::module_::import("vkdose.errors").attr("Fault");
    py::list faults;
    for (const Diagnostic& d : error.faults())
        faults.append(fault(d.file, d.line, d.key, d.value, d.problem, d.remedy));
    return py::tuple(faults);
}

std::string textOf(const CaseError& error) {
    std::string text;
    for (const Diagnostic& d : error.faults()) text += (text.empty() ? "" : "\n") + d.text();
    return text;
}

void translate(std::exception_ptr error) {
    try {
        if (error) std::rethrow_exception(std::move(error));
    } catch (const CaseError& e) {
        raise("InputError", textOf(e), faultsOf(e));
    } catch (const UsageError& e) {
        raise("InputError", std::string(e.what()));
    } catch (const FolderError& e) {
        raise("InputError", std::string(e.what()));
    } catch (const ReadError& e) {
        raise("InputError", std::string(e.what()));
    } catch (const OutputError& e) {
        raise("OutputError", std::string(e.what()));
    } catch (const RunError& e) {
        raise("RunError", std::string(e.what()));
    } catch (const DeviceError& e) {
        raise("DeviceError", e.what() + memoryLimitText());
    } catch (const ForkError& e) {
        raise("VkdoseError", std::string(e.what()));
    }
}

/// Calls in which another thread of Python may work: their simulations, once for each call. Python's lock guards it.
std::multiset<Simulation*> underWay;
bool pythonEnds = false;

void requirePython() {
    if (pythonEnds) throw std::runtime_error("Python is ending, so no simulation goes on");
}

/// Such a call, while it lives.
class Call {
  public:
    explicit Call(Simulation& run) {
        run.requireOwnProcess();
        requirePython();
        at_ = underWay.insert(&run);
    }
    ~Call() { underWay.erase(at_); }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

  private:
    std::multiset<Simulation*>::iterator at_;
};

/// Before Python ends, all simulations rest and all calls return. Python ends a daemon thread where it asks for its
/// lock, and if this is below a function of C++, the whole process ends abnormally. Calls that a fork has left here
/// belong to threads of another process and never return.
void restAll() {
    pythonEnds = true;
    const auto ours = [] {
        std::vector<Simulation*> runs;
        for (Simulation* run : underWay)
            if (run->inOwnProcess()) runs.push_back(run);
        return runs;
    };
    for (std::vector<Simulation*> runs = ours(); !runs.empty(); runs = ours()) {
        for (Simulation* run : runs) run->halt();
        const py::gil_scoped_release release;
        std::this_thread::sleep_for(kMoment);
    }
}

/// Waits with Python's lock released. A signal whose handler raises, such as Ctrl-C, lets the run rest first.
void wait(Simulation& run) {
    const auto rests = [&run] {
        const py::gil_scoped_release release;
        return run.awaitRest(kLookEvery);
    };
    while (!rests()) {
        if (PyErr_CheckSignals() == 0) continue;
        const py::error_already_set raised;
        run.halt();
        while (!rests()) {
        }
        throw py::error_already_set(raised);
    }
    if (!run.over()) requirePython();
}

py::dict sampleOf(const Simulation& run) {
    const Sample& s = run.last();
    py::dict dict = dictOf(kSampleColumns, s);
    if (s.energy) dict.attr("update")(dictOf(kEnergyColumns, *s.energy));
    if (run.theCase().world.repeats()) dict.attr("update")(dictOf(kThroughColumns, s.sensors));
    py::dict bodies, regions, powders;
    const std::vector<std::string> names = loadNames(run.theCase().world);
    for (std::size_t b = 0; b < s.bodies.size(); ++b) bodies[names.at(b).c_str()] = dictOf(kBodyColumns, s.bodies[b]);
    for (std::size_t b = 0, free = 0; b < s.bodies.size() && free < s.free.size(); ++b) {
        const RigidBody& body = run.theCase().world.bodies.at(b);
        if (!body.movesFreely()) continue;
        const FreePlace& place = s.free[free++];
        const auto update = bodies[body.name.c_str()].attr("update");
        update(dictOf(kFreeBodyColumns, place));
        if (place.hinged) update(dictOf(kHingedBodyColumns, place));
    }
    for (std::size_t r = 0; r < s.regions.size(); ++r)
        regions[run.theCase().world.regions.at(r).name.c_str()] = dictOf(kRegionSampleColumns, s.regions[r]);
    for (std::size_t k = 0; k < s.powders.size(); ++k)
        powders[powdersOf(run.theCase()).at(k).name.c_str()] = dictOf(kPowderColumns, s.powders[k]);
    if (!bodies.empty()) dict["bodies"] = bodies;
    if (!regions.empty()) dict["regions"] = regions;
    if (!powders.empty()) dict["powders"] = powders;
    return dict;
}

py::list dosesOf(const Simulation& run) {
    py::list list;
    for (const Dose& d : run.doses()) list.append(dictOf(kDoseColumns, d));
    return list;
}

/// A field of the case, now.
py::dict fieldOf(const Simulation& run, const std::string& name) {
    for (const FieldSensor& sensor : run.theCase().fields)
        if (sensor.name == name)
            return arraysOf(sensor, run.field(sensor.request), solidDensity(run.theCase(), sensor.request.material));
    throw py::key_error(name);
}

std::vector<std::string> fieldNames(const Simulation& run) {
    std::vector<std::string> names;
    for (const FieldSensor& sensor : run.theCase().fields) names.push_back(sensor.name);
    return names;
}

py::dict particlesOf(const Simulation& run) {
    return arraysOf(particlesGrid(run.frame(), run.theCase().world, 0), "position");
}

py::dict contactsOf(const Simulation& run) {
    return arraysOf(contactsGrid(run.frame(), run.theCase().world), "ends");
}

std::unique_ptr<Simulation> open(const std::string& file, const std::vector<std::string>& settings,
                                 const std::string& backend, const std::string& device) {
    Case c = loadCase(file, settings);
    return std::make_unique<Simulation>(std::move(c), openBackend({backend, device, false}));
}

}  // namespace

PYBIND11_MODULE(_core, m) {
    tryLawsOnDevices();
    m.doc() = "Runs inside Python; see vkdose.Simulation.";
    py::register_local_exception_translator(translate);
    py::module_::import("atexit").attr("register")(py::cpp_function(restAll));
    py::class_<Simulation>(m, "Simulation")
        .def(py::init(&open), py::arg("file"), py::arg("settings"), py::arg("backend"), py::arg("device"))
        .def("advance",
             [](Simulation& run, double seconds) {
                 const Call call(run);
                 run.advance(seconds);
                 wait(run);
             })
        .def("advance_to_dose",
             [](Simulation& run) {
                 const Call call(run);
                 run.advanceToDose();
                 wait(run);
             })
        .def("change_speed",
             [](Simulation& run, double rpm) { run.changeSpeed(rpm / kRpm.perSI); })  // as a case file does
        .def("stop_drive", &Simulation::stopDrive)
        .def("add_powder", &Simulation::addPowder)
        .def_property_readonly("takes_orders", &Simulation::takesOrders)
        .def_property_readonly("name", [](const Simulation& run) { return run.theCase().name; })
        .def_property_readonly("backend", &Simulation::backend)
        .def_property_readonly("sensor_interval", [](const Simulation& run) { return run.theCase().sensorInterval; })
        .def_property_readonly("over", &Simulation::over)
        .def_property_readonly("stop_reason", [](const Simulation& run) { return stopKeyword(run.reason()); })
        .def_property_readonly(
            "stop_sentence",
            [](const Simulation& run) { return stopSentence(run.reason(), run.theCase().schedule.stop); })
        .def_property_readonly("time", &Simulation::time)
        .def_property_readonly("dose_mass", &Simulation::doseMass)
        .def_property_readonly("sample", &sampleOf)
        .def_property_readonly("doses", &dosesOf)
        .def_property_readonly("state", [](const Simulation& run) { return State{run.particles()}; })
        .def("is_now", [](const Simulation& run, const State& state) { return run.particles() == state.particles; })
        .def_property_readonly("particles", &particlesOf)
        .def_property_readonly("contacts", &contactsOf)
        .def_property_readonly("fields", &fieldNames)
        .def("field", &fieldOf)
        .def("store", [](Simulation& run, const std::string& folder, bool force) {
            const Call call(run);
            const py::gil_scoped_release release;
            run.store(folder, force);
        });
    py::class_<State>(m, "State")
        .def_property_readonly("positions", &State::positions)
        .def_property_readonly("velocities", &State::velocities)
        .def_property_readonly("spins", &State::spins)
        .def_property_readonly("radii", &State::radii)
        .def_property_readonly("status", &State::status);
}
