#include "calib/inspect/log_drawing.h"

#include <algorithm>

namespace armcal {
namespace {

std::optional<SeriesEnvelope> Envelope(const Log& log,
                                       const Eigen::MatrixXd& signals,
                                       int most_bins) {
  if (signals.size() == 0) return std::nullopt;
  SeriesEnvelope envelope(static_cast<int>(signals.cols()), most_bins);
  const int last = log.size() - 1;
  const double gap = 3 * (log.t[last] - log.t[0]) / std::max(1, last);
  for (int k = 0; k <= last; ++k) {
    if (k > 0 && log.t[k] - log.t[k - 1] > gap) envelope.Break();
    envelope.Add(log.t[k], signals.row(k));
  }
  return envelope;
}

}  // namespace

LogDrawing DrawLog(const Log& log, int most_bins) {
  LogDrawing drawing;
  drawing.commanded = log.qref.size() > 0;
  Eigen::MatrixXd position = log.q;
  if (drawing.commanded) {
    position.resize(log.size(), 3 * log.q.cols());
    position << log.q, log.qref, log.q - log.qref;
  }
  drawing.position = Envelope(log, position, most_bins);
  drawing.velocity = Envelope(log, log.qd, most_bins);
  drawing.torque = Envelope(log, log.tau, most_bins);
  return drawing;
}

}  // namespace armcal
