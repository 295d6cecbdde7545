#include "calib/diagnose/select/events.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {
namespace {

using Eigen::VectorXd;
using Search = EffectParameter::Search;

}  // namespace

GapEvent EventBeyondFriction(const GapRows& rows, const FrictionExcess& excess,
                             const Contact& contact) {
  const ContactStrength strength = StrengthOf(rows, excess, contact);
  GapEvent event;
  event.contact = contact;
  event.beyond_friction = true;
  event.delta_chi2 = event.score = strength.all;
  event.one_joint = strength.one_joint / strength.all;
  return event;
}

const Contact& ToldContact(const GapEvent& event) {
  return event.as_pulse ? *event.as_pulse : event.contact;
}

void SortByTime(std::vector<GapEvent>* events) {
  std::sort(events->begin(), events->end(),
            [](const GapEvent& a, const GapEvent& b) {
              return a.contact.window.begin < b.contact.window.begin;
            });
}

std::vector<GapEvent> JoinedPulses(std::vector<GapEvent> events) {
  SortByTime(&events);
  std::vector<GapEvent> joined;
  for (const GapEvent& event : events) {
    const auto before =
        std::find_if(joined.begin(), joined.end(), [&](const GapEvent& other) {
          return event.pulse && other.pulse &&
                 other.contact.log == event.contact.log &&
                 other.contact.joint == event.contact.joint &&
                 event.contact.window.begin <= other.contact.window.end;
        });
    if (before == joined.end()) {
      joined.push_back(event);
      continue;
    }
    const GapEvent other = *before;
    if (event.contact.deviations > other.contact.deviations) *before = event;
    before->contact.window = {
        other.contact.window.begin,
        std::max(other.contact.window.end, event.contact.window.end)};
    before->delta_chi2 = other.delta_chi2 + event.delta_chi2;
    before->score = other.score + event.score;
  }
  return joined;
}

void DescribeAgain(const Robot& robot, const GapRows& rows,
                   const FrictionExcess& alone, const FrictionExcess& given,
                   std::vector<GapEvent>* events) {
  *events = JoinedPulses(std::move(*events));
  for (GapEvent& event : *events) {
    if (event.pulse) continue;
    const Contact before = event.contact;
    event.contact = DescribeContact(robot, rows, event.at_rest ? alone : given,
                                    before.log, before.window);
    event.contact.window = before.window;
    if (event.fitted) event.contact.force = before.force;
  }
}

TimeRange WindowOf(const GapCandidate& candidate) {
  double time = 0, width = 0;
  for (size_t k = 0; k < candidate.effect->parameters.size(); ++k) {
    const Search search = candidate.effect->parameters[k].search;
    if (search == Search::kTime) time = candidate.p[k];
    if (search == Search::kDuration) width = candidate.p[k];
  }
  return {time - Limits().event_reach * width,
          time + Limits().event_reach * width};
}

bool IsKnown(const std::vector<GapEvent>& events, int log, double time) {
  return std::any_of(events.begin(), events.end(), [&](const GapEvent& event) {
    return event.contact.log == log && event.contact.window.Contains(time);
  });
}

int RowsOf(const GapRows& rows, const GapEvent& event) {
  int count = 0;
  for (int j = 0; j < rows.num_joints(); ++j) {
    for (const GapRows::Place& place : rows.PlacesOfRows(j)) {
      count += rows.segments()[place.segment].log == event.contact.log &&
               event.contact.window.Contains(place.time);
    }
  }
  return count;
}

std::vector<GapEvent> BeyondFriction(const std::vector<GapEvent>& events) {
  std::vector<GapEvent> contacts;
  std::copy_if(events.begin(), events.end(), std::back_inserter(contacts),
               [](const GapEvent& event) { return event.beyond_friction; });
  return contacts;
}

void MaskEvents(const std::vector<GapEvent>& events, GapData* data) {
  for (const GapEvent& event : events) {
    data->Mask(event.contact.log, event.contact.window);
  }
}

VectorXd CourseOf(const GapRows& rows, const GapEvent& event) {
  const TimeRange& window = event.contact.window;
  const double centre = (window.begin + window.end) / 2;
  const double width = (window.end - window.begin) / (2 * Limits().event_reach);
  VectorXd course = VectorXd::Zero(rows.num_thin());
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i);
    if (rows.segments()[i].log != event.contact.log) continue;
    for (int k = rows.thin_begin(s); k < rows.thin_begin(s + 1); ++k) {
      course[k] =
          std::exp(-std::pow((rows.thin_time(s, k) - centre) / width, 2));
    }
  }
  return course;
}

// A touch is felt by all joints between it and the base; what one joint alone
// feels may be its own friction. The same course in time, as a torque on one
// joint each, is asked for its delta_chi2, and the best of them is divided by
// the event's: near 1 where that joint alone explains it.
double OneJointShare(const GapScreen& screen, const GapRows& rows,
                     const GapEvent& event) {
  const VectorXd course = CourseOf(rows, event);
  double most = 0;
  for (int j = 0; j < rows.num_joints(); ++j) {
    JointRows column(rows.num_joints());
    column[j] = rows.Whiten(j, course);
    if (column[j].norm() < 1e-9) continue;
    most = std::max(most, screen.DeltaChi2Of({column}));
  }
  return most / std::max(1., event.delta_chi2);
}

}  // namespace armcal
