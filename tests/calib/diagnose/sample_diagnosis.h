#pragma once

#include <cmath>
#include <string>

#include "calib/diagnose/diagnosis.h"
#include "model/effects/effects.h"

namespace armcal {

inline FoundEffect MakeFound(const std::string& name, int joint) {
  FoundEffect found;
  found.effect = FindEffect(name);
  found.joint = joint;
  found.probability = .9;
  found.estimates = {{"size", "N m", 1.25}, {"share", "1", .5}};
  found.stddev = {.04, .01};
  found.removed_percent = 40;
  found.fitted = {0};
  return found;
}

// One of everything that a diagnosis can say.
inline GapDiagnosis SampleDiagnosis() {
  GapDiagnosis diagnosis;
  for (const char* name : {"shoulder", "elbow"}) {
    JointGap joint;
    joint.name = name;
    joint.unit = "N m";
    joint.nominal_rms = 4;
    joint.refit_rms = 3;
    joint.after_rms = 1;
    joint.organised.by = "speed";
    diagnosis.joints.push_back(joint);
  }
  diagnosis.verdict = GapVerdict::kExplained;
  diagnosis.effects = {MakeFound("stribeck", 1), MakeFound("payload", -1)};
  FoundEffect& first = diagnosis.effects[0];
  first.equivalent = {{FindEffect("presliding"), 1, .08, 10}};
  first.separate_by = "constant velocities";
  diagnosis.candidates = {{first.effect, 1, .9, 30}};
  diagnosis.moved = {{"forearm.mass", "kg", 2, 2.5, .1, 3, {}}};
  diagnosis.untestable = {{"backlash", "elbow", "the load never reverses"}};
  diagnosis.data = {{"currents", "no torque column", "`torque_constants`"}};
  diagnosis.torque.nominal = 12;
  diagnosis.torque.refit = 9;
  diagnosis.torque.after = 1.5;
  diagnosis.torque.removed_percent = 93.4;
  diagnosis.torque.removed_from_nominal_percent = 95;
  diagnosis.bandwidth_hz = 8;
  diagnosis.unexplained = {"elbow", "time", .1};
  return diagnosis;
}

inline FoundEffect MakeTouched() {
  FoundEffect found = MakeFound("external_contact", -1);
  Contact contact;
  contact.window = {1, 2.5};
  contact.time = 1.5;
  contact.joint = 1;
  contact.torque = Eigen::Vector2d(3, -40);
  contact.stddev = Eigen::Vector2d(.5, 2);
  found.contacts = {contact, contact};
  return found;
}

}  // namespace armcal
