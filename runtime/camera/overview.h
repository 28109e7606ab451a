// A camera that shows a whole model.
#pragma once

#include "runtime/camera/camera.h"

namespace farcell {

// Looks at the centre of the box from the side and above (30 degrees), with all its corners just inside the picture of
// width / height = aspect. `up` is a unit axis.
Camera overviewCamera(glm::dvec3 min, glm::dvec3 max, glm::dvec3 up, double aspect);

}  // namespace farcell
