#pragma once
// A powder with draws of its parameters, run in the element tests of the figures that its laboratory measured.

#include <filesystem>
#include <string>
#include <vector>

#include "host/core/csv_table.h"
#include "host/model/powder_file.h"
#include "host/study/sheet_aims.h"
#include "host/study/study.h"

namespace vkdose {

/// The figures of a powder's laboratory that have the names of a laboratory sheet, with the usual error where the file
/// states none. Throws CaseError if one has no value that such a figure can have.
LaboratorySheet sheetOf(const PowderFile& powder);

/// The tests of these figures, each once: "bulk", "heap", "drum", "ring-shear".
std::vector<std::string> testsOf(const std::vector<SheetAim>& aims);

/// The case of an element test. `tables` is the folder with the studies of the tables.
std::filesystem::path caseOfTest(const std::filesystem::path& tables, const std::string& test);

/// The study of a test with each of the first `count` draws of the powder. Its spheres have the density of the table's,
/// and in the ring shear test the Bond number that does at the test's load what the powder's does at its own: so the
/// table is read, too. Throws CaseError if the powder has fewer draws.
Study confirmingStudy(const PowderFile& powder, const LaboratorySheet& sheet, const std::filesystem::path& tables,
                      const std::string& test, int count);

/// What the runs of a test say in a figure, beside the laboratory.
struct ConfirmedFigure {
    SheetAim aim;
    std::vector<double> values;          ///< of the runs that have it
    double mean = 0, standardError = 0;  ///< NaN without values; the error for fewer than two

    /// Whether the two agree within two standard errors of both.
    bool met() const;
};

/// The figures of a test by the `figures` of its runs, a row for each.
std::vector<ConfirmedFigure> confirmedFigures(const std::vector<SheetAim>& aims, const std::string& test,
                                              const Table& figures);

/// The text of a powder file with these figures in [[held]], in the place of those that it had of the same test; those
/// without a value are left out. `test` is the path of its case, as the file is to name it.
std::string withHeld(const std::string& text, const std::string& test, const std::vector<ConfirmedFigure>& figures,
                     const std::string& note);

}  // namespace vkdose
