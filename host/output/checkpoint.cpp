#include "host/output/checkpoint.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "host/core/file.h"
#include "host/core/fnv.h"
#include "host/core/number.h"
#include "host/output/hdf5.h"

namespace vkdose {

namespace {

constexpr std::size_t kUserBlock = 512;
constexpr std::string_view kMagic = "vkdose checkpoint";
constexpr unsigned kVersion = 7;  // 6: no loads of the coil

/// It belongs to the format. With another checksum (zlib's, say) existing checkpoints could not be read.
std::uint64_t checksum(std::string_view bytes) {
    return fnv1a(bytes);
}

std::string head(std::string_view body) {
    std::string block =
        fmt::format("{}\nversion {}\nbytes {}\nchecksum {:016x}\n", kMagic, kVersion, body.size(), checksum(body));
    block.resize(kUserBlock, '\0');
    return block;
}

/// The whole number behind `word` at the front of `head`, which loses both.
std::optional<unsigned long long> takeLine(std::string_view& head, std::string_view word) {
    if (!head.starts_with(word)) return std::nullopt;
    head.remove_prefix(word.size());
    const std::string_view digits = head.substr(0, head.find('\n'));
    head.remove_prefix(digits.size());
    return wholeNumberOf(digits);
}

/// The HDF5 part of a checkpoint whose head has been checked.
std::string_view body(const std::string& bytes, const std::string& name) {
    const auto refuse = [&](const std::string& why) { throw CheckpointError(fmt::format("{} {}", name, why)); };
    if (bytes.compare(0, kMagic.size(), kMagic) != 0) refuse("is not a checkpoint of vkdose");
    if (bytes.size() < kUserBlock) refuse("is cut off");
    std::string_view lines = std::string_view(bytes).substr(kMagic.size(), kUserBlock - kMagic.size());
    const auto version = takeLine(lines, "\nversion "), size = takeLine(lines, "\nbytes ");
    if (!version || !size) refuse("has a damaged head");
    if (*version != kVersion)
        refuse(fmt::format("has format version {}; this vkdose reads version {}", *version, kVersion));
    const std::string_view rest = std::string_view(bytes).substr(kUserBlock);
    if (rest.size() < *size) refuse(fmt::format("is cut off: {} of {} bytes are there", rest.size(), *size));
    if (std::string_view(bytes).substr(0, kUserBlock) != head(rest)) refuse("is damaged: its checksum does not fit");
    return rest;
}

void saveMarks(const Checkpoint& c, Record& when) {
    std::vector<std::uint64_t> fields;
    std::vector<std::uint32_t> checksums;
    for (const CsvMark* mark : {&c.timeSeries, &c.doses, &c.frames}) checksums.push_back(mark->checksum.value_or(0));
    for (const CsvMark& mark : c.fields) {
        fields.push_back(mark.bytes);
        checksums.push_back(mark.checksum.value_or(0));
    }
    when.putOne("timeseries", c.timeSeries.bytes);
    when.putOne("doses", c.doses.bytes);
    when.putOne("frames", c.frames.bytes);
    when.put("fields", std::move(fields));
    when.put("checksums", std::move(checksums));
}

void restoreMarks(const Record& when, Checkpoint& c) {
    c.timeSeries.bytes = when.one<std::uint64_t>("timeseries");
    c.doses.bytes = when.one<std::uint64_t>("doses");
    c.frames.bytes = when.one<std::uint64_t>("frames");
    for (const std::uint64_t bytes : when.get<std::uint64_t>("fields")) c.fields.push_back({bytes});
    const auto& checksums = when.get<std::uint32_t>("checksums", 3 + c.fields.size());
    c.timeSeries.checksum = checksums[0];
    c.doses.checksum = checksums[1];
    c.frames.checksum = checksums[2];
    for (std::size_t k = 0; k < c.fields.size(); ++k) c.fields[k].checksum = checksums[3 + k];
}

std::string imageOf(const Checkpoint& c) {
    hdf5::Writer writer;
    writer.text("/program", c.program);
    writer.text("/backend", c.backend);
    writer.text("/case", c.caseText);
    writer.text("/given", c.given);
    writer.text("/origin", c.origin);
    writer.record("/run", c.run.run);
    writer.record("/state", c.run.backend);
    Record when;
    when.putOne("time", c.time);
    saveMarks(c, when);
    when.putOne("member", c.member);
    when.putOne("keeps_states", std::uint32_t(c.keepsStates ? 1 : 0));
    writer.record("/when", when);
    return writer.image();
}

}  // namespace

void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& c) {
    const std::string image = hdf5::made(file, [&] { return imageOf(c); });
    replaceFile(file, head(image) + image);
}

Checkpoint readCheckpoint(const std::filesystem::path& file) {
    const std::optional<std::string> bytes = fileContent(file);
    if (!bytes) throw CheckpointError(fmt::format("no checkpoint: {}", unreadable(file)));
    const std::string_view rest = body(*bytes, file.string());
    try {
        const hdf5::Reader reader{std::string(rest)};
        Checkpoint c;
        c.program = reader.text("/program");
        c.backend = reader.text("/backend");
        c.caseText = reader.text("/case");
        c.run = {reader.record("/run"), reader.record("/state")};
        const Record when = reader.record("/when");
        c.time = when.one<double>("time");
        restoreMarks(when, c);
        c.member = when.one<std::uint32_t>("member");
        c.keepsStates = when.one<std::uint32_t>("keeps_states") != 0;
        c.given = reader.text("/given");
        c.origin = reader.text("/origin");
        return c;
    } catch (const hdf5::Error& e) {
        throw CheckpointError(fmt::format("{} cannot be read: {}", file.string(), e.what()));
    } catch (const RecordError& e) {
        throw CheckpointError(fmt::format("{} cannot be used: {}; run the case once more", file.string(), e.what()));
    }
}

}  // namespace vkdose
