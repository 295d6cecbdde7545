#include "model/robot_tree/mesh_inertia.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "model/robot_files/mjcf/mjcf_reader.h"
#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::mesh_inertia_test {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::Contains;
using testing::HasSubstr;

// Adds the twelve triangles of a box; a hollow has its outside within.
void AddBox(const Vector3d& center, const Vector3d& half, bool hollow,
            TriangleMesh* mesh) {
  const int first = static_cast<int>(mesh->points.size());
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    mesh->points.push_back(center + half.cwiseProduct(corner));
  }
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    for (const auto& [b, c] : {std::pair{f[1], f[2]}, {f[2], f[3]}}) {
      mesh->triangles.push_back(
          {first + f[0], first + (hollow ? c : b), first + (hollow ? b : c)});
    }
  }
}

Matrix3d AboutCenter(const InertialParameters& V) {
  const Vector3d com = V.first_moment / V.mass;
  return V.inertia - V.mass * (com.squaredNorm() * Matrix3d::Identity() -
                               com * com.transpose());
}

Vector3d BoxMoments(double mass, const Vector3d& half) {
  const Vector3d s = half.cwiseAbs2();
  return mass / 3 * Vector3d(s[1] + s[2], s[0] + s[2], s[0] + s[1]);
}

TEST(MeshInertia, OfABox) {
  const Vector3d center(.3, -.2, .1), half(.1, .2, .3);
  TriangleMesh mesh;
  AddBox(center, half, false, &mesh);
  for (const MeshVolume how : {MeshVolume::kExact, MeshVolume::kAbsolute}) {
    const InertialParameters V = MeshInertia(mesh, how);
    EXPECT_NEAR(V.mass, 8 * half.prod(), 1e-15);
    EXPECT_LE((V.first_moment - V.mass * center).norm(), 1e-15);
    const Matrix3d expected = BoxMoments(V.mass, half).asDiagonal();
    EXPECT_LE((AboutCenter(V) - expected).norm(), 1e-15);
  }
}

// A cube with side 2 and one of side 1 cut out of its middle: taken away by the
// true volume, added where every pyramid counts.
TEST(MeshInertia, OfAHollow) {
  TriangleMesh mesh;
  AddBox(Vector3d::Zero(), Vector3d::Ones(), false, &mesh);
  AddBox(Vector3d::Zero(), Vector3d::Ones() / 2, true, &mesh);
  const double outer = 8 * 2. / 3, inner = 1 * .5 / 3;
  const InertialParameters exact = MeshInertia(mesh, MeshVolume::kExact);
  EXPECT_NEAR(exact.mass, 7, 1e-14);
  EXPECT_LE((exact.inertia - (outer - inner) * Matrix3d::Identity()).norm(),
            1e-14);
  const InertialParameters all = MeshInertia(mesh, MeshVolume::kAbsolute);
  EXPECT_NEAR(all.mass, 9, 1e-14);
  EXPECT_LE((all.inertia - (outer + inner) * Matrix3d::Identity()).norm(),
            1e-14);
}

// Two boxes that stand into each other, as MuJoCo 4.0.0 compiles them
// (inertia="legacy", "exact" and "shell", density 1).
TEST(MeshInertia, AsMujocoHasIt) {
  TriangleMesh mesh;
  AddBox(Vector3d::Zero(), {.25, .125, .125}, false, &mesh);
  AddBox({.25, 0, .25}, {.125, .125, .25}, false, &mesh);
  Matrix3d solid, shell;
  solid << 0.002115885416666672, 0, -0.000976562500000003, 0,
      0.003580729166666676, 0, -0.000976562500000003, 0, 0.002115885416666672;
  shell << 0.05533854166666681, 0, -0.019531250000000045, 0,
      0.08723958333333355, 0, -0.019531250000000045, 0, 0.0553385416666668;
  for (const auto& [how, mass, expected] :
       {std::tuple{MeshVolume::kAbsolute, .0625, solid},
        {MeshVolume::kExact, .0625, solid},
        {MeshVolume::kShell, 1.25, shell}}) {
    const InertialParameters V = MeshInertia(mesh, how);
    EXPECT_NEAR(V.mass, mass, 1e-14);
    EXPECT_LE((V.first_moment / V.mass - Vector3d(.125, 0, .125)).norm(),
              1e-14);
    EXPECT_LE((AboutCenter(V) - expected).norm(), 1e-12);
  }
}

// A cube of side 1 as OBJ, its faces of four corners.
const char kCube[] =
    "# cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\n"
    "v 0 1 1\nvn 0 0 1\nf 4 3 2 1\nf 5/1/1 6/1/1 7/1/1 8/1/1\nf 1 2 6 5\n"
    "f 2 3 7 6\nf -6 -5 -1 -2\nf 4 1 5 8\n";

Robot ReadCube(const std::string& mesh, const std::string& geom,
               const std::string& obj = kCube) {
  const std::string file = WriteFile(obj, "cube.obj");
  const std::string name = file.substr(file.rfind('/') + 1);
  return ReadMjcf(
      WriteFile("<mujoco><asset><mesh name='m' file='" + name + "' " + mesh +
                    "/></asset><worldbody><body name='arm'><joint/><geom "
                    "type='mesh' mesh='m' " +
                    geom + "/></body></worldbody></mujoco>",
                "arm.xml"),
      {});
}

// Scaled to 1 x 2 x 3 after its middle was moved to the origin; 600 kg/m^3.
TEST(MjcfMeshes, GiveBodiesTheirInertia) {
  const Robot robot =
      ReadCube("refpos='.5 .5 .5' scale='1 2 3'", "density='600' pos='0 0 4'");
  const InertialParameters& V = robot.links[0].inertial;
  EXPECT_NEAR(V.mass, 3600, 1e-9);
  EXPECT_LE((V.first_moment - Vector3d(0, 0, 4 * 3600)).norm(), 1e-9);
  EXPECT_NEAR(V.inertia(2, 2), BoxMoments(3600, {.5, 1, 1.5})[2], 1e-9);
  EXPECT_THAT(robot.notes,
              Contains(HasSubstr("read as well, for inertia that the file does "
                                 "not give: ")));
  // A mirrored surface encloses what it did.
  EXPECT_NEAR(ReadCube("scale='-1 1 1' inertia='exact'", "density='5'")
                  .links[0]
                  .inertial.mass,
              5, 1e-14);
  EXPECT_NEAR(ReadCube("", "mass='5'").links[0].inertial.mass, 5, 1e-14);
}

std::string Refusal(const std::string& mesh, const std::string& geom,
                    const std::string& obj = kCube) {
  return MessageOf<InputError>("", [&] { ReadCube(mesh, geom, obj); });
}

TEST(MjcfMeshes, RefuseWhatIsNoBody) {
  EXPECT_THAT(Refusal("", "", "v 0 0 0\n"),
              HasSubstr("expected a surface that encloses a volume"));
  EXPECT_THAT(Refusal("", "", "v 0 0\n"),
              HasSubstr("line 1: expected three numbers behind v"));
  EXPECT_THAT(Refusal("", "", "v 0 0 0\nf 1 2 3\n"),
              HasSubstr("line 2: found '1': expected the number of one of 1 "
                        "points"));
  EXPECT_THAT(Refusal("", "", "v 0 0 0\nf 1 x 3\n"),
              HasSubstr("found 'x': expected the number of a point"));
  EXPECT_THAT(Refusal("inertia='convex'", ""),
              HasSubstr("armcal computes no convex hulls"));
  EXPECT_EQ(Refusal("inertia='convex'", "density='0'"), "");
}

// A binary STL says how many triangles it has, and a bomb is one that lies.
TEST(MeshFile, RefusesCountsThatAreNotThere) {
  const auto refusal = [](const std::string& name, const std::string& bytes) {
    const std::string path = WriteFile(bytes, name);
    return MessageOf<InputError>(path, [&] { ReadMeshFile(path); });
  };
  EXPECT_EQ(refusal("a.stl", std::string(80, ' ') + "\xFF\xFF\xFF\xFF"),
            "FILE: byte 84: expected 214748364750 bytes behind the counts");
  EXPECT_EQ(refusal("a.stl", "solid"), "FILE: byte 0: expected more bytes");
  EXPECT_EQ(refusal("a.msh", std::string(16, '\xFF')),
            "FILE: byte 4: expected counts that are not negative");
  EXPECT_EQ(refusal("a.dae", "x"),
            "FILE: found '.dae': expected a mesh that ends in .stl, .obj or "
            ".msh");
}

}  // namespace armcal::mesh_inertia_test
