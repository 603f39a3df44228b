#include "host/study/calibration_aim.h"

#include "host/model/case_reader.h"

namespace vkdose {

CalibrationAim readCalibrationAim(CaseReader&, Section&, const std::filesystem::path&) {
    return {};
}

}  // namespace vkdose
