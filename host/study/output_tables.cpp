#include "host/study/output_tables.h"

#include "host/sim/dose.h"
#include "host/study/member_result.h"

namespace vkdose {

std::vector<OutputTable> outputTables() {
    std::vector<ColumnText> members{
        {"member", "1", "Number of the member, from 0."},
        {"seed", "1", "Seed of the member's case."},
        {"KEY", "", "Value of the key in the member's case; a column for each key of the study, named by it."}};
    std::vector<ColumnText> doses = members;
    for (const MemberColumn& c : kMemberColumns) members.push_back({c.name, c.unit, c.meaning});
    for (const ColumnText& c : columnTexts(kDoseColumns)) doses.push_back(c);
    std::vector<OutputTable> tables = runTables();
    tables.push_back({"members.csv, of a sweep", "A line for every member that has ended.", members});
    tables.push_back({"doses.csv, of a sweep", "A line for every dose of every member that has ended.", doses});
    tables.push_back({"figures.csv, of a sweep",
                      "A line for every member that has ended well, once all have ended.",
                      {{"member", "1", "Number of the member, from 0."},
                       {"seed", "1", "Seed of the member's case."},
                       {"KEY", "", "As in members.csv."},
                       {"FIGURE", "",
                        "A figure that a target of a calibration can name, `heap.angle_deg`; a column for each figure "
                        "that some member has, named by it. Empty where the member has none."}}});
    tables.push_back(
        {"powder-draws.csv, of a calibration",
         "A line for each draw from the distribution of the parameters that fit. All are equally probable, "
         "and their order says nothing.",
         {{"KEY", "", "Value of the parameter, in the unit of its key; a column for each, named by it."}}});
    return tables;
}

}  // namespace vkdose
