#include "host/studio/workbench.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "host/core/printable.h"

namespace vkdose::studio {

namespace fs = std::filesystem;

void answerWith(httplib::Response& response, std::string text, const std::string& type) {
    if (text.empty()) return response.set_content("", type);
    const auto kept = std::make_shared<const std::string>(std::move(text));
    response.set_content_provider(kept->size(), type,
                                  [kept](std::size_t from, std::size_t length, httplib::DataSink& sink) {
                                      return sink.write(kept->data() + from, length);
                                  });
}

Json bodyOf(const httplib::Request& request) {
    // What is no JSON of the page, a form of another site say, is told apart by its type.
    if (request.get_header_value("Content-Type").rfind("application/json", 0) != 0)
        throw Refused(415, "the request is no JSON");
    if (request.body.size() > kMostText) throw Refused(413, "the request is larger than 4 MiB");
    Json body = Json::parse(request.body, nullptr, false);
    if (!body.is_object()) throw Refused(400, "the request is no JSON object");
    return body;
}

std::string textOf(const Json& body, const char* name) {
    if (!body.contains(name) || !body[name].is_string()) throw Refused(400, fmt::format("{} is missing", name));
    return body[name].get<std::string>();
}

fs::path Workbench::fileOf(const std::string& name) const {
    const auto file = workspace_.inside(name);
    if (!file) throw Refused(403, fmt::format("{} is not in the folder of this workbench", printable(name)));
    return *file;
}

fs::path Workbench::caseOf(const std::string& name) const {
    fs::path file = fileOf(name);
    if (file.extension() != ".toml") throw Refused(403, fmt::format("{} is no case file (.toml)", printable(name)));
    return file;
}

std::optional<OwnLaw> Workbench::lawToAskFor(const fs::path& file) const {
    auto law = ownLawOf(file);
    if (law && laws_.has(law->text)) law.reset();
    return law;
}

void Workbench::requireAllowed(const fs::path& file) const {
    if (const auto law = lawToAskFor(file))
        throw Refused(403, fmt::format("{} is a law that nobody has allowed; open the case", printable(law->file)));
}

Workbench::Said Workbench::said(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) const {
    Said all;
    Child child(program_, arguments, workspace_.folder());
    all.ended = child.read([&](const std::string& line) { all.text += line + "\n"; }, limit, &stop_);
    return all;
}

namespace {

/// What to tell of a command that did not end well.
std::string whyNot(const std::string& command, const Ended& e) {
    if (!e.error.empty()) return e.error;
    if (e.late) return fmt::format("vkdose {} takes too long; is the machine busy?", command);
    return fmt::format("vkdose {} ended with {}", command, e.code);
}

}  // namespace

std::string Workbench::done(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) const {
    const Said all = said(arguments, limit);
    const Ended& e = all.ended;
    if (e.code == 0) return all.text;
    throw Refused(409, whyNot(arguments.front(), e));
}

Json Workbench::asked(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) const {
    const Said all = said(arguments, limit);
    Json json = Json::parse(all.text, nullptr, false);
    if (!json.is_discarded()) return json;
    const Ended& e = all.ended;
    throw Refused(500, whyNot(arguments.front(), e));
}

}  // namespace vkdose::studio
