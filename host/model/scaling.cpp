#include "host/model/scaling.h"

#include <fmt/format.h>

#include "host/model/powders.h"

namespace vkdose {

double readScaling(CaseReader& reader, Section& contact, NormalLaw law, const Case& c) {
    if (contact.choice("scaling").value_or(0) == 0 || c.filling.list) return 1;
    const double s = c.filling.size.scaleUp;
    for (const PowderOf& powder : powdersOf(c))
        if (powder.filling.size.scaleUp != s)
            reader.fault(powder.path + ".size.scale_up",
                         fmt::format("is {:.6g}, and that of particles.size is {:.6g}: contact.scaling = \"stress\" "
                                     "needs one for all powders",
                                     powder.filling.size.scaleUp, s),
                         "give both the same, or parameters of the spheres and contact.scaling = \"none\"");
    if (law == NormalLaw::User && s != 1)
        reader.fault(contact.path("scaling"),
                     "does not know what the parameters of a law of one's own are, and how they grow with the spheres",
                     "give those of the spheres and \"none\": what is in N/m times scale_up, in N or kg/s times its "
                     "square, in J times its cube; what is in Pa or a ratio as it is");
    return s;
}

}  // namespace vkdose
