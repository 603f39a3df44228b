// From a case file to a Case: read the tables, then work out what follows from them.
#include "host/model/case.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "host/core/printable.h"
#include "host/model/case_keys.h"
#include "host/model/case_reader.h"
#include "host/model/case_sections.h"
#include "host/model/checks.h"
#include "host/model/parse_toml.h"
#include "host/model/powder_file.h"

namespace vkdose {
namespace {

/// Refuses a study. It has the shape of a case, so that without this check every key of it would be reported as
/// unknown.
void refuseStudy(const Node& tree) {
    for (const char* name : {"axis", "calibrate", "design", "set"}) {
        const Node* node = tree.child(name);
        if (node == nullptr || (node->kind != Node::Kind::Array && node->kind != Node::Kind::Table)) continue;
        throw CaseError({{node->file, node->line, "", "", "this is a study, not a case",
                          "give it to `vkdose sweep`, or name its base case here"}});
    }
}

Case interpret(const std::filesystem::path& file, Node tree, std::vector<std::filesystem::path> files) {
    refuseStudy(tree);
    CaseReader reader(file.string(), std::move(tree), caseKeys());
    CaseRead read = readCase(reader, file);
    reader.finish();
    checkFields(reader, read.c);
    reader.throwIfFaulty();
    Case c = resolveCase(reader, std::move(read));
    files.insert(files.end(), c.files.begin(), c.files.end());
    c.files = std::move(files);
    c.resolved = reader.resolved();
    (void)parseToml(c.resolved, "the case with all its defaults");  // or a run could not go on from its folder
    return c;
}

/// Interprets a case and keeps it as it was given.
Case interpretKept(const std::filesystem::path& file, Node tree, std::vector<std::filesystem::path> files) {
    std::string given = treeText(tree);
    const bool named = tree.child("name") != nullptr;
    Case c = interpret(file, std::move(tree), std::move(files));
    c.given = named ? std::move(given) : fmt::format("name = {}\n{}", tomlString(c.name), given);
    return c;
}

}  // namespace

Case loadCase(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return loadVariant(file, {overrideTree(overrides)});
}

Case loadVariant(const std::filesystem::path& file, std::vector<Node> layers) {
    std::vector<std::filesystem::path> files;
    Node tree = readTree(file, files);
    for (Node& layer : layers) layOver(tree, std::move(layer), files);
    return interpretKept(file, std::move(tree), std::move(files));
}

Case loadResolvedCase(const std::string& text, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides) {
    std::vector<std::filesystem::path> files{file};
    Node tree;
    layOver(tree, readTreeText(text, file.string()), files);
    layOver(tree, overrideTree(overrides), files);
    return interpretKept(file, std::move(tree), std::move(files));
}

}  // namespace vkdose
