#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace armcal {

// What a camera saw of a board (a chessboard, tags): some of its points in each
// image, the arm at rest. Images in rows.
struct BoardImages {
  Eigen::MatrixXd q;         // rad or m, images x joints
  std::vector<long> row;     // the first line of each in the file, header = 1
  std::vector<long> number;  // as the file numbers them
  std::vector<int> camera;   // which took it, from 0
  std::vector<Eigen::Matrix3Xd> points;  // m, in the board's frame
  std::vector<Eigen::Matrix2Xd> pixels;  // where they were seen, px

  int size() const { return static_cast<int>(q.rows()); }
};

// Reads a table with a row for each point that was seen: image, a whole number,
// rows of one image one below the other; joint positions like a log's; bx by
// [bz], the point on the board (m or [mm]); u v, px; camera, where there are
// several, which took it (from 1). An image has four points or more, one
// posture and one camera. Throws InputError.
BoardImages ReadBoardImages(const std::string& path,
                            const std::vector<std::string>& joint_names);

}  // namespace armcal
