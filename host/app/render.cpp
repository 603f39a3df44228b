#include <fmt/format.h>

#include <charconv>
#include <functional>
#include <optional>
#include <stdexcept>

#include "host/app/commands.h"
#include "host/app/exit_code.h"
#include "host/app/film.h"
#include "host/app/find_case.h"
#include "host/app/inputs.h"
#include "host/app/run_states.h"
#include "host/app/tell.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/output/run_files.h"
#include "host/render/picture.h"
#include "host/vk/device.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

constexpr int kSmallest = 64, kLargest = 16384;

bool isRun(const RenderOptions& options) {
    std::error_code code;
    return fs::is_directory(options.input.file, code);
}

RunStates statesOf(const RenderOptions& options) {
    const CaseOptions& input = options.input;
    if (!isRun(options)) return RunStates(loadCase(findCase(input.file), input.overrides));
    if (!input.overrides.empty())
        throw UsageError(fmt::format("--set {}: {} is the folder of a run, whose case is what it was; give a case",
                                     input.overrides.front(), input.file.string()));
    return RunStates(input.file);
}

/// The files that are read, which no picture may replace.
std::vector<fs::path> filesRead(const RenderOptions& options, const RunStates& states) {
    return isRun(options) ? filesOfRun(options.input.file) : states.setup().files;
}

fs::path pictureOf(const RenderOptions& options) {
    if (!options.out.empty()) return options.out;
    return isRun(options) ? options.input.file / "picture.png"
                          : fs::path(findCase(options.input.file).stem().string() + ".png");
}

/// "1280x720" to pixels; zero, zero for nothing.
std::pair<int, int> sizeOf(const std::string& text) {
    if (text.empty()) return {0, 0};
    int width = 0, height = 0;
    const char* end = text.data() + text.size();
    const auto [cross, fault] = std::from_chars(text.data(), end, width);
    const bool crossed = fault == std::errc() && cross != end && *cross == 'x';
    const auto [stop, fault2] = std::from_chars(crossed ? cross + 1 : end, end, height);
    if (!crossed || fault2 != std::errc() || stop != end || width < kSmallest || width > kLargest ||
        height < kSmallest || height > kLargest)
        throw UsageError(fmt::format("--size {}: give width x height in pixels, {} to {} each: --size 1280x720", text,
                                     kSmallest, kLargest));
    return {width, height};
}

/// Nothing of a case moves yet, so that what tells its particles apart is coloured.
render::Quantity quantityOf(const RenderOptions& options, const Case& c) {
    const std::vector<std::string>& properties = c.world.properties;
    if (!options.color.empty()) {
        if (const auto quantity = render::quantityNamed(options.color, properties)) return *quantity;
        std::string known = fmt::format("{}", fmt::join(render::kQuantityNames, ", "));
        for (const std::string& property : properties) known += ", " + property;
        throw UsageError(fmt::format("--color {}: is no quantity of these particles; known: {}", options.color, known));
    }
    if (isRun(options)) return render::Quantity::KineticEnergy;
    return powdersOf(c.world).size() > 1 ? render::Quantity::Powder : render::Quantity::Radius;
}

/// Draws the states of a run, all with the same scale, camera and size.
class Renderer {
  public:
    Renderer(const RenderOptions& options, const RunStates& states, const std::vector<std::size_t>& chosen)
        : states_(states),
          quantity_(quantityOf(options, states.setup())),
          device_(vk::DeviceChoice{options.backend.device, options.backend.validation}),
          caster_(device_) {
        spec_.view = *render::viewNamed(options.view);
        spec_.coil = !options.noCoil;
        spec_.bodies = bodiesOf(states.setup());
        std::tie(spec_.width, spec_.height) = sizeOf(options.size);
        if (quantity_ == render::Quantity::FillLayer) {
            if (!states.hasFrames())
                throw UsageError(
                    "--color fill-layer: the run kept no frames ([frames] in its case does), so nobody knows "
                    "where its particles lay when the powder had settled");
            fill_ = states.read(states.settled()).particles;
        }
        // One pass over all states to be drawn sets scale and camera, so that nothing jumps from one picture to the
        // next.
        std::vector<double> values =
            fill_ ? render::valuesOf(quantity_, states.setup(), fillFrame(), fillPointer()) : std::vector<double>();
        for (const std::size_t entry : chosen) {
            const Frame frame = states.read(entry);
            const Box box = render::contentOf(states.setup(), frame, spec_.bodies);
            const Vec3 towards = render::cameraFor(spec_.view, box, kSmallest, kSmallest).towards;
            lookThrough(spec_.bodies, states.setup(), frame, towards, box);
            content_ = content_ ? render::united(*content_, box) : box;
            if (!fill_) {
                const std::vector<double> more = valuesOf(frame);
                values.insert(values.end(), more.begin(), more.end());
            }
        }
        try {
            spec_.scale = render::scaleFor(quantity_, states.setup(), values, {options.from, options.to});
        } catch (const std::invalid_argument& e) {
            throw UsageError(e.what());
        }
    }

    render::Canvas draw(const std::vector<std::size_t>& chosen) {
        std::vector<Frame> frames;
        for (const std::size_t entry : chosen) frames.push_back(states_.read(entry));
        std::vector<render::Panel> panels;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const std::string mark = frames.size() > 1 ? fmt::format("({}) ", char('a' + i % 26)) : std::string();
            panels.push_back({&frames[i], valuesOf(frames[i]), mark + render::stateText(states_.setup(), frames[i])});
        }
        return render::drawPicture(caster_, states_.setup(), spec_, *content_, panels);
    }

    const vk::Device& device() const { return device_; }

  private:
    Frame fillFrame() const { return {0, 0, Phase::Settle, 0, 0, *fill_, {}}; }
    const Particles* fillPointer() const { return fill_ ? &*fill_ : nullptr; }
    std::vector<double> valuesOf(const Frame& frame) const {
        return render::valuesOf(quantity_, states_.setup(), frame, fillPointer());
    }

    const RunStates& states_;
    render::Quantity quantity_;
    vk::Device device_;
    render::RayCaster caster_;
    render::PictureSpec spec_;
    std::optional<Particles> fill_;
    std::optional<Box> content_;
};

void writePicture(const fs::path& file, const render::Canvas& canvas) {
    replaceFile(file, canvas.png());
    tell("{}\n", printable(file.string()));
}

std::string pictureName(std::size_t i) {
    return fmt::format("frame_{:06}.png", i);
}

/// Pictures of one film must not mix with those of another, nor replace a user's own.
void requireNoPictures(const fs::path& folder) {
    for (const fs::path& entry : entriesOf(folder)) {
        const std::string name = entry.filename().string();
        if (name.starts_with("frame_") && name.ends_with(".png"))
            throw OutputError(fmt::format("{} holds {} already; name another folder, or remove the pictures from it",
                                          folder.string(), name));
    }
}

void writeMovie(Renderer& renderer, const RenderOptions& options, std::size_t count) {
    const fs::path& to = options.movie;
    std::optional<Film> film;
    if (!to.has_extension()) createFolder(to);
    for (std::size_t i = 0; i < count; ++i) {
        const render::Canvas canvas = renderer.draw({i});
        if (!to.has_extension()) {
            replaceFile(to / pictureName(i), canvas.png());
            continue;
        }
        if (canvas.width() % 2 != 0 || canvas.height() % 2 != 0)
            throw UsageError(fmt::format("--size {}: a film has even width and height", options.size));
        if (!film) film.emplace(to, canvas.width(), canvas.height(), options.rate);
        film->add(canvas.bytes());
    }
    if (film) film->finish();
    tell("{} pictures in {}\n", count, printable(to.string()));
}

std::vector<std::size_t> chosenOf(const RenderOptions& options, const RunStates& states) {
    std::vector<std::size_t> chosen;
    if (!options.movie.empty())
        for (std::size_t i = 0; i < states.entries().size(); ++i) chosen.push_back(i);
    else if (options.panels)
        chosen = states.story();
    else if (options.times.empty())
        chosen.push_back(states.entries().size() - 1);
    for (const double time : options.times) chosen.push_back(states.at(time));
    return chosen;
}

}  // namespace

int renderCommand(const RenderOptions& options) {
    const RunStates states = statesOf(options);
    const fs::path picture = pictureOf(options);
    keepInputs(filesRead(options, states), {picture, options.movie});
    requireSuffix(picture, ".png", "a PNG picture");
    if (!options.movie.has_extension() && !options.movie.empty()) requireNoPictures(options.movie);
    if ((options.panels || !options.movie.empty()) && !states.hasFrames())
        throw UsageError(fmt::format("{} {}", options.input.file.string(),
                                     isRun(options)
                                         ? "kept no frames ([frames] in its case does), only its end can be drawn"
                                         : "is a case, only its start can be drawn"));
    const std::vector<std::size_t> chosen = chosenOf(options, states);
    Renderer renderer(options, states, chosen);
    if (!options.movie.empty())
        writeMovie(renderer, options, chosen.size());
    else
        writePicture(picture, renderer.draw(chosen));
    return validationClean(options.backend, renderer.device()) ? kOk : kDeviceError;
}

}  // namespace vkdose
