#include "host/app/orders.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "host/core/error.h"
#include "host/core/key.h"
#include "host/core/number.h"
#include "host/core/output_file.h"
#include "host/play/simulation.h"

namespace vkdose {

namespace {

constexpr std::size_t kLongest = 1000;  // characters of an order

bool hasNews(int file) {
    pollfd news{file, POLLIN, 0};
    return poll(&news, 1, 0) > 0;
}

}  // namespace

Orders::Orders(const Case& c, int file) : case_(c), file_(file), refills_(c.refills.size(), false) {}

std::vector<Orders::Refused> Orders::hear() {
    while (open_ && hasNews(file_)) {
        std::array<char, 1024> part{};
        const ssize_t n = retried([&] { return ::read(file_, part.data(), part.size()); });
        open_ = n > 0;
        if (open_) text_.append(part.data(), std::size_t(n));
        if (text_.size() > 64 * kLongest) break;
    }
    std::vector<Refused> refused;
    for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
        const std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        if (auto why = obey(line)) refused.push_back({line.substr(0, kLongest), std::move(*why)});
    }
    if (text_.size() > kLongest) {
        refused.push_back({text_.substr(0, kLongest), "is longer than an order"});
        text_.clear();
    }
    return refused;
}

/// Why an order is refused, if it is.
std::optional<std::string> Orders::obey(const std::string& line) {
    const std::size_t first = line.find_first_not_of(" \t"), last = line.find_last_not_of(" \t\r");
    const std::size_t gap = std::min(line.find_first_of(" \t", first), last + 1);
    const std::string verb = line.substr(first, gap - first);
    const std::size_t from = line.find_first_not_of(" \t", gap);
    const std::string rest = from < last + 1 ? line.substr(from, last + 1 - from) : "";
    if (verb == "refill") return takeRefill(rest);
    if (verb == "stop" && rest.empty()) {
        if (!turns_) return "the drive does not turn now";
        stop_ = true;
        return std::nullopt;
    }
    if (verb != "speed" && verb != "dose") return "is no order; there are: speed RPM, dose GRAMS, stop, refill NAME";
    const auto number = numberOf(rest);
    if (!number || !std::isfinite(*number)) return fmt::format("give a number: {} 60", verb);
    if (verb == "dose") {
        if (!(*number > 0)) return "give a mass > 0 g";
        target_ = *number * 1e-3;
        targetDose_ = turns_ ? dose_ : 0;
        return std::nullopt;
    }
    try {
        requireDriveSpeed(case_, *number / kRpm.perSI);
    } catch (const CaseError& e) {
        return e.faults().empty() ? "no case has such a speed" : e.faults().front().problem;
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    speed_ = *number / kRpm.perSI;
    return std::nullopt;
}

std::optional<std::string> Orders::takeRefill(const std::string& name) {
    for (std::size_t k = 0; k < case_.refills.size(); ++k) {
        if (case_.refills[k].name != name) continue;
        if (refills_[k]) return "it has been added";
        refills_[k] = true;
        return std::nullopt;
    }
    return "the case has no [[refill]] of this name";
}

void Orders::look(const Sample& sample) {
    if (sample.dose != dose_) {
        before_ = out_;
        dose_ = sample.dose;
    }
    out_ = sample.sensors.mass[std::size_t(Region::Dosed)];
    const bool turned = turns_;
    turns_ = sample.phase == Phase::Rotate;
    if (turned && !turns_) stop_ = false;
    if (turned && !turns_ && targetDose_ == dose_) target_.reset();  // this dose is over without it
}

DriveOrder Orders::take() {
    if (target_ && targetDose_ == 0) targetDose_ = dose_;
    if (target_ && out_ - before_ >= *target_) {
        target_.reset();
        stop_ = true;
    }
    return {std::exchange(stop_, false), std::exchange(speed_, std::nullopt)};
}

}  // namespace vkdose
