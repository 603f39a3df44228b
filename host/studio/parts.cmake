# The files of the workbench's page as C++ strings, studio/parts.h in the build folder. Scenes, charts and style are
# those of the report; D3 and three.js are Debian's.
set(report ${CMAKE_SOURCE_DIR}/host/report)
set(shared "")
foreach(file charts ramp controls stream player_frames player_colours player_bodies player_scene player run)
  list(APPEND shared ${report}/${file}.js)
endforeach()

function(vkdose_page_part variable path type)
  set(all "")
  foreach(file ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    string(APPEND all "${text}")
  endforeach()
  set(part "    {\"${path}\", \"${type}\", R\"_part_(${all})_part_\"},\n")
  set(${variable} "${${variable}}${part}" PARENT_SCOPE)
endfunction()

set(studio_parts "")
vkdose_page_part(studio_parts / "text/html; charset=utf-8" ${CMAKE_CURRENT_LIST_DIR}/studio.html)
vkdose_page_part(studio_parts /page/studio.css "text/css; charset=utf-8" ${CMAKE_CURRENT_LIST_DIR}/studio.css)
vkdose_page_part(studio_parts /page/report.css "text/css; charset=utf-8" ${report}/page.css)
set(page "")
foreach(file studio studio_picture studio_case studio_form studio_studies studio_runs studio_folder)
  list(APPEND page ${CMAKE_CURRENT_LIST_DIR}/${file}.js)
endforeach()
vkdose_page_part(studio_parts /page/studio.js "text/javascript; charset=utf-8" ${page})
vkdose_page_part(studio_parts /page/report.js "text/javascript; charset=utf-8" ${shared})
vkdose_page_part(studio_parts /page/d3.js "text/javascript; charset=utf-8" ${D3_SCRIPT})
vkdose_page_part(studio_parts /page/three.js "text/javascript; charset=utf-8" ${THREE_SCRIPT})
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/studio/parts.h CONTENT
"#pragma once\n

namespace vkdose::studio::parts {\n
struct Part {
    const char* path;
    const char* type;
    const char* text;
};
inline constexpr Part kParts[] = {
\${studio_parts}};\n
}  // namespace vkdose::studio::parts
")
