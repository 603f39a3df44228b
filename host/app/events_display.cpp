#include "host/app/events_display.h"

#include "host/app/interrupt.h"
#include "host/app/tell.h"
#include "host/core/json.h"
#include "host/core/key.h"
#include "host/core/printable.h"
#include "host/model/powders.h"

namespace vkdose {

using Json = nlohmann::ordered_json;

EventsDisplay::EventsDisplay(const Case& c, std::unique_ptr<Orders> orders, std::FILE* stream)
    : case_(c), orders_(std::move(orders)), stream_(stream) {}

void EventsDisplay::begin(const Insertion& filled, const std::filesystem::path& output, const std::string& backend,
                          double from) {
    Json refills = Json::array();
    for (const Refill& refill : case_.refills) refills.push_back(refill.name);
    say({{"event", "run"},
         {"case", case_.name},
         {"particles", filled.particles.size()},
         {"filled_kg", jsonNumber(filled.mass)},
         {"output", std::filesystem::absolute(output).string()},
         {"backend", backend},
         {"version", VKDOSE_VERSION},
         {"refills", refills},
         {"from_s", jsonNumber(from)}});
}

void EventsDisplay::warn(const Warning& w) {
    say({{"event", "warning"},
         {"name", w.name},
         {"key", w.key},
         {"value", w.value},
         {"text", w.text},
         {"cure", w.cure},
         {"accepted", w.accepted}});
}

void EventsDisplay::onProgress(const Progress& p) {
    if (p.phase == phase_ && p.dose == dose_) return;
    phase_ = p.phase;
    dose_ = p.dose;
    say({{"event", "phase"},
         {"phase", phaseName(p.phase)},
         {"dose", p.dose},
         {"time_s", jsonNumber(p.time)},
         {"step", p.step},
         {"expected_steps", p.expectedSteps}});
}

void EventsDisplay::onSample(const Sample& sample) {
    if (orders_) {
        orders_->look(sample);
        hearOrders();
    }
    Json event{{"event", "sample"}, {"step", sample.step}};
    putColumns(kSampleColumns, sample, event);
    if (sample.energy) putColumns(kEnergyColumns, *sample.energy, event);
    if (case_.world.repeats()) putColumns(kThroughColumns, sample.sensors, event);
    const std::vector<std::string> names = loadNames(case_.world);
    for (std::size_t b = 0; b < sample.bodies.size(); ++b)
        putColumns(kBodyColumns, sample.bodies[b], event["bodies"][names.at(b)]);
    for (std::size_t b = 0, free = 0; b < sample.bodies.size() && free < sample.free.size(); ++b) {
        const RigidBody& body = case_.world.bodies.at(b);
        if (!body.movesFreely()) continue;
        const FreePlace& place = sample.free[free++];
        putColumns(kFreeBodyColumns, place, event["bodies"][body.name]);
        if (place.hinged) putColumns(kHingedBodyColumns, place, event["bodies"][body.name]);
    }
    for (std::size_t r = 0; r < sample.regions.size(); ++r)
        putColumns(kRegionSampleColumns, sample.regions[r], event["regions"][case_.world.regions.at(r).name]);
    for (std::size_t k = 0; k < sample.powders.size(); ++k)
        putColumns(kPowderColumns, sample.powders[k], event["powders"][powdersOf(case_).at(k).name]);
    say(event);
}

void EventsDisplay::onSettled(const Settling& settling, const Case&) {
    say({{"event", "settled"},
         {"time_s", jsonNumber(settling.time)},
         {"at_rest", settling.atRest},
         {"speed_m_s", jsonNumber(settling.speed)},
         {"fall_speed_m_s", jsonNumber(settling.fallSpeed)},
         {"spilled_kg", jsonNumber(settling.spilled)}});
}

void EventsDisplay::onDose(const Dose& dose) {
    Json event{{"event", "dose"}};
    putColumns(kDoseColumns, dose, event);
    const std::vector<std::string> names = loadNames(case_.world);
    for (std::size_t b = 0; b < dose.bodies.size(); ++b)
        putColumns(kDoseBodyColumns, dose.bodies[b], event["bodies"][names.at(b)]);
    for (std::size_t r = 0; r < dose.regions.size(); ++r)
        putColumns(kRegionColumns, dose.regions[r], event["regions"][case_.world.regions.at(r).name]);
    for (std::size_t k = 0; k < dose.powders.size(); ++k)
        putColumns(kPowderDoseColumns, dose.powders[k], event["powders"][powdersOf(case_).at(k).name]);
    say(event);
}

void EventsDisplay::onRefill(const AddedPowder& powder) {
    say({{"event", "refill"},
         {"name", powder.name},
         {"time_s", jsonNumber(powder.time)},
         {"particles", powder.particles},
         {"mass_kg", jsonNumber(powder.mass)}});
}

void EventsDisplay::hearOrders() {
    for (const Orders::Refused& r : orders_->hear())
        say({{"event", "refused"}, {"order", printable(r.order)}, {"why", printable(r.why)}});
}

DriveOrder EventsDisplay::order() {
    if (!orders_) return {};
    hearOrders();
    return orders_->take();
}

void EventsDisplay::onOrder(const GivenOrder& given) {
    const auto& speed = given.order.speed;
    say({{"event", "order"},
         {"order", orderWord(given.order)},
         {"time_s", jsonNumber(given.time)},
         {"speed_rpm", speed ? jsonNumber(*speed * kRpm.perSI) : Json(nullptr)}});
}

bool EventsDisplay::wantsRefill(std::size_t refill) {
    if (!orders_) return false;
    hearOrders();
    return orders_->wantsRefill(refill);
}

void EventsDisplay::end(const RunResult& result, ExitCode code, const std::string& error,
                        const std::filesystem::path& output) {
    say({{"event", "end"},
         {"stop_reason", stopKeyword(result.reason)},
         {"stop_sentence", stopSentence(result.reason, case_.schedule.stop)},
         {"code", static_cast<int>(code)},
         {"error", error.empty() ? Json(nullptr) : Json(error)},
         {"output", std::filesystem::absolute(output).string()}});
}

void EventsDisplay::say(const Json& event) {
    if (!heard_) return;
    const std::string line = event.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    heard_ = vkdose::say(stream_, line) && sendText(stream_);
    if (!heard_) interruptSelf();
}

}  // namespace vkdose
