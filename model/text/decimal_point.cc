#include "model/text/decimal_point.h"

namespace armcal {

DecimalPoint::DecimalPoint() {
  static const locale_t c = newlocale(LC_ALL_MASK, "C", nullptr);
  before_ = uselocale(c);
}

DecimalPoint::~DecimalPoint() { uselocale(before_); }

}  // namespace armcal
