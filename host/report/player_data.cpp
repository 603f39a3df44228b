#include "host/report/player_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "host/analysis/free_surface.h"
#include "host/analysis/overlap.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/json.h"
#include "host/law/user_law.h"
#include "host/model/case_tree.h"
#include "host/model/powders.h"
#include "host/report/deflate.h"
#include "host/report/player_bodies.h"
#include "host/report/thinning.h"

namespace vkdose::report {

namespace {

constexpr double kSlowest = 1e-5, kFastest = 10;  // [m/s]
constexpr std::size_t kMostMemory = 150'000'000;  // bytes of particles in the browser
constexpr std::size_t kMostFrames = 65'535;       // the number of the last frame stands for "never gone"
constexpr std::uint16_t kNever = 65'535;

std::uint16_t sixteenBits(double value, double low, double high) {
    const double part = high > low ? (value - low) / (high - low) : 0;
    return static_cast<std::uint16_t>(std::lround(std::clamp(part, 0.0, 1.0) * 65'535));
}

std::uint8_t eightBits(double value, double low, double high) {
    return static_cast<std::uint8_t>(std::lround(sixteenBits(value, low, high) / 257.0));
}

std::uint8_t speedLevel(double speed) {
    if (!(speed >= kSlowest)) return 0;
    const double part = std::log(speed / kSlowest) / std::log(kFastest / kSlowest);
    return static_cast<std::uint8_t>(1 + std::lround(std::min(part, 1.0) * 254));
}

std::uint8_t overlapLevel(double ratio, double most) {
    return static_cast<std::uint8_t>(std::lround(std::sqrt(std::clamp(ratio / most, 0.0, 1.0)) * 255));
}

void addPlanes(Deflate& stream, const std::vector<std::uint16_t>& values) {
    std::vector<std::uint8_t> bytes;
    for (const std::uint16_t v : values) bytes.push_back(static_cast<std::uint8_t>(v & 255));
    for (const std::uint16_t v : values) bytes.push_back(static_cast<std::uint8_t>(v >> 8));
    stream.add(bytes);
}

/// Values of one kind, frame after frame, as differences. A value that is not set stays as it was, and costs next to
/// nothing.
template <typename Value>
class Row {
  public:
    explicit Row(std::size_t size) : before_(size, 0), now_(size, 0) {}

    void set(std::size_t i, Value value) { now_[i] = value; }

    void add(Deflate& stream) {
        std::vector<Value> change(now_.size());
        for (std::size_t i = 0; i < now_.size(); ++i) {
            const auto c = static_cast<Value>(now_[i] - before_[i]);
            if constexpr (sizeof(Value) == 1)
                change[i] = c;
            else
                change[i] = static_cast<Value>(c & 0x8000 ? ~(c << 1) : c << 1);
        }
        before_ = now_;
        if constexpr (sizeof(Value) == 1)
            stream.add(change);
        else
            addPlanes(stream, change);
    }

  private:
    std::vector<Value> before_, now_;
};

/// The least and largest value of a property, frame by frame.
struct PropertyRange {
    std::vector<double> low, high;
};

/// The stream of one choice of frames.
class Encoder {
  public:
    Encoder(const Case& c, std::size_t particles, std::size_t columns)
        : case_(c),
          came_(particles, kNever),
          gone_(particles, kNever),
          place_(3, Row<std::uint16_t>(particles)),
          speed_(particles),
          overlap_(particles),
          properties_(c.world.properties.size(), Row<std::uint8_t>(particles)),
          ranges_(properties_.size()),
          surface_(columns),
          columns_(columns) {}

    void add(const Frame& frame) {
        const Particles& p = frame.particles;
        if (p.size() != gone_.size())
            throw CaseError({{"frames", 0, "", fmt::format("{}", p.size()),
                              fmt::format("particles in the frame at {} s, {} in the first", frame.time, gone_.size()),
                              "give the frames of one run"}});
        if (frames_ == 0) addRadii(p);
        addParticles(p, overlapRatios(p, case_.world, frame.coilAngle, frame.time, frame.bodiesMoved));
        addSurface(p);
        ++frames_;
    }

    std::size_t characters() const { return stream_.size() / 3 * 4; }
    const std::vector<double>& radiusRange() const { return radiusRange_; }
    const std::vector<PropertyRange>& propertyRanges() const { return ranges_; }

    std::string finish() {
        addPlanes(stream_, came_);
        addPlanes(stream_, gone_);
        return base64(stream_.finish());
    }

  private:
    void addRadii(const Particles& p) {
        if (p.size() > 0) {
            const auto [low, high] = std::minmax_element(p.radius.begin(), p.radius.end());
            radiusRange_ = {*low, *high};
        }
        std::vector<std::uint16_t> radii;
        for (const double r : p.radius) radii.push_back(sixteenBits(r, radiusRange_[0], radiusRange_[1]));
        addPlanes(stream_, radii);
        if (case_.furtherPowders.empty()) return;
        std::vector<std::uint8_t> powders;
        for (const std::uint8_t m : p.material) powders.push_back(static_cast<std::uint8_t>(powderIndex(case_, m)));
        stream_.add(powders);
    }

    void addParticles(const Particles& p, const std::vector<double>& overlap) {
        const Box& box = case_.world.domain;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const bool here = p.status[i] == Status::Active;
            const auto frame = static_cast<std::uint16_t>(frames_);
            if (here) came_[i] = std::min(came_[i], frame);
            if (!here && p.status[i] != Status::Waiting) gone_[i] = std::min(gone_[i], frame);
            speed_.set(i, here ? speedLevel(glm::length(p.velocity[i])) : 0);
            overlap_.set(i, here ? overlapLevel(overlap[i], case_.world.maxOverlapRatio) : 0);
            if (here)
                for (int k = 0; k < 3; ++k) place_[k].set(i, sixteenBits(p.position[i][k], box.low[k], box.high[k]));
        }
        for (auto& row : place_) row.add(stream_);
        speed_.add(stream_);
        overlap_.add(stream_);
        for (std::size_t k = 0; k < properties_.size(); ++k) addProperty(p, k);
    }

    void addProperty(const Particles& p, std::size_t k) {
        double low = kInfinity, high = -kInfinity;
        for (const LawProperties& own : p.properties) {
            low = std::min(low, own[k]);
            high = std::max(high, own[k]);
        }
        if (!(low <= high)) low = high = 0;  // a frame of a run without them
        for (std::size_t i = 0; i < p.properties.size(); ++i)
            properties_[k].set(i, eightBits(p.properties[i][k], low, high));
        properties_[k].add(stream_);
        ranges_[k].low.push_back(low);
        ranges_[k].high.push_back(high);
    }

    void addSurface(const Particles& p) {
        if (columns_ == 0) return;
        const SurfaceProfile profile = surfaceProfile(p, *case_.canister, columns_, Across::Highest);
        const double height = case_.world.domain.high.y - case_.world.domain.low.y;
        for (std::size_t i = 0; i < columns_; ++i) surface_.set(i, sixteenBits(profile.height[i], 0, height));
        surface_.add(stream_);
    }

    const Case& case_;
    Deflate stream_;
    std::vector<double> radiusRange_{0, 0};
    std::vector<std::uint16_t> came_, gone_;
    std::vector<Row<std::uint16_t>> place_;
    Row<std::uint8_t> speed_, overlap_;
    std::vector<Row<std::uint8_t>> properties_;
    std::vector<PropertyRange> ranges_;
    Row<std::uint16_t> surface_;
    std::size_t columns_, frames_ = 0;
};

Json propertiesJson(const Case& c, const std::vector<PropertyRange>& ranges) {
    Json all = Json::array();
    for (std::size_t k = 0; k < ranges.size(); ++k)
        all.push_back({{"name", c.world.properties[k]},
                       {"low", jsonNumbers(ranges[k].low)},
                       {"high", jsonNumbers(ranges[k].high)}});
    return all;
}

Json vectorJson(const Vec3& v) {
    return {jsonNumber(v.x), jsonNumber(v.y), jsonNumber(v.z)};
}

Json sceneJson(const Case& c) {
    Json j;
    j["low"] = vectorJson(c.world.domain.low);
    j["high"] = vectorJson(c.world.domain.high);
    j["powders"] = Json::array();
    for (const PowderOf& p : powdersOf(c))
        j["powders"].push_back({{"name", p.name}, {"density", jsonNumber(c.world.density(p.material))}});
    j["slowest_m_s"] = kSlowest;
    j["fastest_m_s"] = kFastest;
    j["most_overlap"] = jsonNumber(c.world.maxOverlapRatio);
    j["canister"] = nullptr;
    if (c.canister) {
        const Canister& can = *c.canister;
        j["canister"] = {{"length", can.length},         {"width", can.width},         {"height", can.height},
                         {"outlet", can.outletDiameter}, {"throat", can.throatLength}, {"flat", can.flatFloor}};
    }
    j["coil"] = nullptr;
    if (c.world.coil) {
        const geometry::Coil& coil = *c.world.coil;
        j["coil"] = {{"radius", coil.radius}, {"pitch", coil.pitch},    {"wire", coil.wireRadius},
                     {"length", coil.length}, {"z_start", coil.zStart}, {"start_angle", coil.startAngle},
                     {"hand", coil.hand}};
    }
    return j;
}

Json framesJson(const std::vector<FrameEntry>& entries) {
    std::vector<double> times, angles;
    std::vector<int> phases, doses;
    for (const FrameEntry& entry : entries) {
        times.push_back(entry.time);
        angles.push_back(entry.coilAngle);
        phases.push_back(static_cast<int>(entry.phase));
        doses.push_back(entry.dose);
    }
    Json j;
    j["time_s"] = jsonNumbers(times);
    j["coil_angle_rad"] = jsonNumbers(angles);
    j["phase"] = phases;
    j["dose"] = doses;
    j["settled"] = settledOf(entries);
    return j;
}

/// The names of the properties that the law of the folder's case gives particles. Empty if the case cannot be read.
std::vector<std::string> propertiesIn(const std::filesystem::path& run) try {
    const Node tree = readTreeText(fileContent(run / "case.toml").value_or(""), "case.toml");
    const Node* contact = tree.child("contact");
    const Node* text = contact != nullptr ? contact->child("law_text") : nullptr;
    return text != nullptr ? readLaw("law", text->string).law.properties : std::vector<std::string>();
} catch (const CaseError&) {
    return {};
}

/// The frame of an entry without its powder.
Frame placesOf(const FrameEntry& entry, const Frame& frame) {
    Frame places;
    places.time = entry.time;
    places.coilAngle = entry.coilAngle;
    places.bodiesMoved = frame.bodiesMoved;
    return places;
}

}  // namespace

FrameSource framesOf(const std::filesystem::path& run) {
    const auto frames = std::make_shared<Frames>(run, propertiesIn(run));
    return {frames->entries(), [frames](const FrameEntry& entry) { return frames->read(entry); }};
}

Json playerJson(const Case& c, const FrameSource& frames, std::size_t columns, std::size_t mostCharacters) {
    if (frames.entries.empty()) return nullptr;
    if (!c.canister) columns = 0;
    const Frame settled = frames.read(frames.entries[settledOf(frames.entries)]);
    const std::size_t particles = settled.particles.size();
    const std::size_t most = std::min(kMostFrames, std::max<std::size_t>(2, kMostMemory / (8 * particles + 1)));
    std::size_t stride = 1 + (frames.entries.size() - 1) / (most - 1);
    const std::size_t taken = bodiesJson(c, {}, settled).dump().size();
    mostCharacters -= std::min(mostCharacters, taken);
    while (true) {
        const std::vector<FrameEntry> entries = thinned(frames.entries, stride);
        const bool least = entries.size() <= 2;
        Encoder encoder(c, particles, columns);
        std::size_t done = 0;
        std::vector<Frame> places;
        for (; done < entries.size() && (least || encoder.characters() <= mostCharacters); ++done) {
            const Frame frame = frames.read(entries[done]);
            encoder.add(frame);
            places.push_back(placesOf(entries[done], frame));
        }
        std::string stream = encoder.finish();
        if (least || (done == entries.size() && stream.size() <= mostCharacters)) {
            Json j = sceneJson(c);
            j["particles"] = particles;
            j["columns"] = columns;
            j["radius_m"] = jsonNumbers(encoder.radiusRange());
            j["properties"] = propertiesJson(c, encoder.propertyRanges());
            j["frames"] = framesJson(entries);
            j["bodies"] = bodiesJson(c, places, settled);
            j["stored"] = frames.entries.size();
            j["every"] = stride;
            j["stream"] = std::move(stream);
            return j;
        }
        // The stride grows by the ratio of all frames to those that fitted, and by at least one.
        stride = std::max(stride + 1, stride * entries.size() / done);
    }
}

}  // namespace vkdose::report
