#pragma once

// A URDF with everything a writer must keep, and the parts of a URDF that it
// must not change.

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <string>

namespace armcal {

// Odd axes, a prismatic joint, fixed links before, between, behind and beside.
inline const char kFile[] = R"(<?xml version="1.0"?>
<!-- a comment --><robot name="arm"><material name="m"><color rgba="1 0 0 1"/>
</material><link name="world"/><link name="mast"><inertial><mass value="9"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<joint name="stand" type="fixed"><parent link="world"/><child link="mast"/>
<origin xyz="0 0.1 0.2" rpy="0 0 0.7"/></joint>
<link name="upper"><visual><geometry><mesh filename="package://a/u.stl"/>
</geometry></visual><inertial><origin rpy="0.1 0.2 0.3" xyz="0.1 0 0"/>
<mass value="3"/><inertia ixx=".1" ixy="0" ixz="0" iyy=".1" iyz="0" izz=".1"/>
</inertial></link><link name="plate"><inertial><origin xyz="0 .05 0"/>
<mass value="1"/><inertia ixx=".01" ixy="0" ixz="0" iyy=".01" iyz="0" izz=".01"
/></inertial></link><joint name="shoulder" type="revolute">
<!-- another --><parent link="mast"/><child link="upper"/><origin xyz="0 0 .5"/>
<axis xyz=".6 0 -.8"/><limit lower="-9" upper="9" effort="10" velocity="3"/>
</joint><joint name="bolts" type="fixed"><parent link="upper"/>
<child link="plate"/><origin xyz=".3 0 .1" rpy=".5 0 1"/></joint>
<link name="slide"><inertial><mass value="2"/><inertia ixx=".02" ixy="0" ixz="0"
 iyy=".02" iyz="0" izz=".02"/></inertial></link>
<joint name="rail" type="prismatic"><parent link="plate"/><child link="slide"/>
<origin xyz=".1 .2 .3" rpy=".4 -.3 .2"/><axis xyz="0 -1 0"/>
<dynamics damping="1" spring="keep"/>
<limit lower="-1" upper="1" effort="10" velocity="3"/></joint>
<link name="wrist"/><link name="tcp"/><joint name="tool" type="fixed">
<parent link="wrist"/><child link="tcp"/><origin xyz="0 0 .1"/></joint>
<joint name="turn" type="continuous"><parent link="slide"/><child link="wrist"/>
<axis xyz="1 1 1"/></joint><transmission name="t"><joint name="turn"/>
<gear>3</gear></transmission></robot>)";

// All of a tree in one text, but for the numbers a calibration changes.
inline void Skeleton(const tinyxml2::XMLNode* node, bool ours,
                     std::string* text) {
  const tinyxml2::XMLElement* e = node->ToElement();
  if (e == nullptr) {
    *text += node->Value();
  } else {
    const std::string tag = e->Name();
    ours = ours || tag == "inertial" || tag == "dynamics";
    *text += "<" + tag;
    for (auto a = e->FirstAttribute(); a != nullptr; a = a->Next()) {
      const bool kept = !ours || std::string(a->Name()) == "spring";
      *text += std::string(" ") + a->Name() + "=" + (kept ? a->Value() : "#");
    }
  }
  for (auto c = node->FirstChild(); c != nullptr; c = c->NextSibling()) {
    Skeleton(c, ours, text);
  }
  if (e != nullptr) *text += ">";
}

inline std::string Skeleton(const std::string& xml) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(xml.c_str()), tinyxml2::XML_SUCCESS);
  std::string text;
  for (auto c = document.FirstChild(); c; c = c->NextSibling()) {
    Skeleton(c, false, &text);
  }
  return text;
}

}  // namespace armcal
