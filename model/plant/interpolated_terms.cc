#include "model/plant/interpolated_terms.h"

namespace armcal {

void InterpolateTerms(const ArmTerms& begin, const ArmTerms& middle,
                      const ArmTerms& end, double share, ArmTerms* now) {
  const double a = (1 - share) * (1 - 2 * share);
  const double b = 4 * share * (1 - share), c = share * (2 * share - 1);
  now->mass_matrix =
      a * begin.mass_matrix + b * middle.mass_matrix + c * end.mass_matrix;
  now->bias = a * begin.bias + b * middle.bias + c * end.bias;
  now->points.resize(begin.points.size());
  for (size_t k = 0; k < begin.points.size(); ++k) {
    now->points[k].jacobian = a * begin.points[k].jacobian +
                              b * middle.points[k].jacobian +
                              c * end.points[k].jacobian;
    now->points[k].X_WP.matrix() = a * begin.points[k].X_WP.matrix() +
                                   b * middle.points[k].X_WP.matrix() +
                                   c * end.points[k].X_WP.matrix();
  }
}

}  // namespace armcal
