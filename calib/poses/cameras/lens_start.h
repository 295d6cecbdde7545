#pragma once

#include <optional>
#include <vector>

#include "calib/poses/cameras/image_view.h"
#include "model/camera/pinhole_camera.h"

namespace armcal {

// The focal lengths and the principal point that images of a flat board tell in
// closed form, the lens ideal otherwise (Zhang 2000, A flexible new technique
// for camera calibration, 3.1, without skew): of each homography (h1 h2 h3) the
// board's axes are at right angles and equally long,
//   h1' B h2 = 0,   h1' B h1 = h2' B h2,   B = K^-T K^-1,
// linear in B. Nothing where the images do not tell it, or the board is not
// flat.
std::optional<PinholeCamera> StartOfLens(const std::vector<ImageView>& views);

}  // namespace armcal
