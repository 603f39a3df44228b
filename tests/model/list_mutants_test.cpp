// Hundreds of broken particle lists, made from three small good ones with a fixed seed: each must be refused with a
// message that names its line or column.
#include <algorithm>
#include <set>

#include "host/model/particle_list.h"
#include "tests/model/case_files.h"
#include "tests/model/mutants.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

namespace {

const std::vector<std::string> kGoodLists{
    "x,y,z,r\n0,0,0,1e-3\n0.01,-0.02,+3e-2,0.5e-3\n0,0.005,0,0.001\n",
    "r,x,y,z,vx,vy,vz\n1e-3,0.01,-0.02,0.03,1,2,3\n2e-3,0.02,-0.02,0.03,0,0,-1\n",
    "id,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,radius_m,status\n"
    "0,1e-2,2e-2,3e-2,4,5,6,7,8,9,1e-3,active\n1,0,0,0,0,0,0,0,0,0,1e-3,active\n"};

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> list;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) list.push_back(cell);
    return list;
}

std::string row(const std::vector<std::string>& list) {
    std::string text;
    for (const std::string& cell : list) text += (text.empty() ? "" : ",") + cell;
    return text;
}

class ListBreaker {
  public:
    ListBreaker(const std::string& text, std::uint32_t seed)
        : lines_(linesOf(text)), names_(cells(lines_[0])), choice_(seed) {}

    std::vector<Mutant> all() {
        for (std::size_t c = 0; c < names_.size(); ++c) {
            header(c);
            if (names_[c] != "id" && names_[c] != "status")
                for (std::size_t r = 1; r < lines_.size(); ++r) numbers(r, c);
        }
        for (std::size_t r = 1; r < lines_.size(); ++r) rows(r);
        files();
        return std::move(mutants_);
    }

  private:
    void add(const std::string& kind, std::string text, std::string culprit, std::size_t line) {
        mutants_.push_back({kind, std::move(text), std::move(culprit), static_cast<int>(line) + 1});
    }
    void cell(const std::string& kind, std::size_t r, std::size_t c, const std::string& now) {
        std::vector<std::string> list = cells(lines_[r]);
        list[c] = now;
        add(kind, withLine(lines_, r, row(list)), now, r);
    }

    void header(std::size_t c) {
        const auto with = [&](const std::vector<std::string>& names) { return withLine(lines_, 0, row(names)); };
        std::vector<std::string> names = names_;
        names[c] += "q";
        add("a column nobody knows", with(names), names[c], 0);
        if (names_[c] == "id" || names_[c] == "status") return;
        names = names_;
        names[(c + 1) % names.size()] = names_[c];
        add("a column named twice", with(names), names_[c], 0);
        names = names_;
        names.erase(names.begin() + static_cast<std::ptrdiff_t>(c));

        add("a column without a name", with(names), "", 0);
    }

    void numbers(std::size_t r, std::size_t c) {
        static const std::vector<std::string> words{"abc", "1.2.3", "0x10", "1e", "--1", "+-1",  "++1", "1 2", "1;2",
                                                    "-",   "+",     "1,e3", "1f", "1_0", "~1.0", "e5",  "#1",  "1e+"};
        static const std::vector<std::string> infinite{"nan", "inf", "-inf", "NaN", "INFINITY"};
        static const std::vector<std::string> beyond{"1e400", "-1e400", "1e300", "1e16"};
        for (int n = 0; n < 3; ++n) {
            const std::string& word = choice_.of(words);
            if (word.find(',') == std::string::npos) cell("no number", r, c, word);
        }
        cell("a number that is not finite", r, c, choice_.of(infinite));
        cell("a number no unit makes sense of", r, c, choice_.of(beyond));
        std::vector<std::string> list = cells(lines_[r]);
        list[c] = " ";
        add("an empty cell", withLine(lines_, r, row(list)), "is empty", r);
        if (names_[c][0] != 'r') return;
        cell("a radius of nothing", r, c, "0");
        cell("a negative radius", r, c, "-1e-3");
        cell("a radius below every unit", r, c, "1e-300");
    }

    void rows(std::size_t r) {
        const std::string& line = lines_[r];
        add("a field too many", withLine(lines_, r, line + ",1"), "fields", r);
        add("a field too few", withLine(lines_, r, line.substr(0, line.rfind(','))), "fields", r);
        std::string semicolons = line;
        std::replace(semicolons.begin(), semicolons.end(), ',', ';');
        add("semicolons", withLine(lines_, r, semicolons), "fields", r);
        add("a quote that does not end", withLine(lines_, r, "\"" + line), "is not CSV", r);
        add("a quote within a field", withLine(lines_, r, "1\"" + line), "is not CSV", r);
        std::string null = line;
        null.insert(choice_.below(null.size()), 1, '\0');
        add("a null byte", withLine(lines_, r, null), "", r);
        if (names_.back() == "status")
            add("a status nobody knows", withLine(lines_, r, line.substr(0, line.rfind(',') + 1) + "alive"), "alive",
                r);
    }

    void files() {
        const auto file = [&](const std::string& kind, const std::string& text) {
            mutants_.push_back({kind, text, "", 0});
        };
        file("nothing", "");
        file("blank lines", "\n\n\n");
        file("a header alone", lines_[0] + "\n");
        std::vector<std::string> headless(lines_.begin() + 1, lines_.end());
        file("no header", joined(headless));
        std::string wide = "\xff\xfe";
        for (const char c : joined(lines_)) wide += std::string{c, '\0'};
        file("UTF-16", wide);
        file("old line ends", [&] {
            std::string text = joined(lines_);
            std::replace(text.begin(), text.end(), '\n', '\r');
            return text;
        }());
    }

    std::vector<std::string> lines_;
    std::vector<std::string> names_;
    Choice choice_;
    std::vector<Mutant> mutants_;
};

}  // namespace

TEST_CASE("hundreds of particle lists that are certainly wrong are refused, each at its line") {
    const Folder folder;
    std::size_t count = 0;
    std::set<std::string> kinds;
    std::uint32_t seed = 1;
    for (const std::string& good : kGoodLists) {
        std::vector<Diagnostic> none;
        CHECK(readParticleList(folder.write("good.csv", good), none).size() >= 2);
        REQUIRE(none.empty());
        for (const Mutant& m : ListBreaker(good, seed++).all()) {
            const auto file = folder.write("mutant.csv", m.text);
            std::vector<Diagnostic> faults;
            REQUIRE_NOTHROW(readParticleList(file, faults));
            INFO(m.kind << "; blames line " << m.line << ", \"" << m.culprit << "\"\n" << m.text);
            CHECK_FALSE(faults.empty());
            for (const Diagnostic& fault : faults) {
                INFO(fault.text());
                CHECK(unclear(fault) == "");
            }
            CHECK(std::any_of(faults.begin(), faults.end(), [&](const Diagnostic& f) {
                return f.file == file.string() && (m.line == 0 || f.line == m.line) &&
                       f.text().find(m.culprit) != std::string::npos;
            }));
            kinds.insert(m.kind);
            ++count;
        }
    }
    CHECK(count >= 200);
    CHECK(kinds.size() >= 20);
}

TEST_CASE("particle lists with bytes changed at random load or are refused clearly") {
    const Folder folder;
    Choice choice(7);
    for (int n = 0; n < 600; ++n) {
        std::string text = choice.of(kGoodLists);
        for (std::size_t times = 1 + choice.below(3); times > 0; --times)
            text[choice.below(text.size())] = static_cast<char>(choice.below(256));
        INFO(text);
        std::vector<Diagnostic> faults;
        Particles p;
        REQUIRE_NOTHROW(p = readParticleList(folder.write("list.csv", text), faults));
        for (const Diagnostic& fault : faults) CHECK(unclear(fault) == "");
        for (std::size_t i = 0; faults.empty() && i < p.size(); ++i) {
            CHECK(p.radius[i] > 0);
            CHECK(std::isfinite(glm::length(p.position[i]) + glm::length(p.velocity[i]) + glm::length(p.spin[i])));
        }
    }
}
