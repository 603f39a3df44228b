#pragma once
// The HTML of a report: one file that needs nothing else, neither a network nor another file.

#include <string>

#include "host/report/run_report.h"

namespace vkdose::report {

/// The page for what runJson or studyJson gave. Whatever stands in the data is shown as text, never taken as markup or
/// script.
std::string page(const Json& data);

}  // namespace vkdose::report
