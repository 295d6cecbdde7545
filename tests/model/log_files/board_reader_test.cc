#include "model/log_files/board_reader.h"

#include <gtest/gtest.h>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::board_reader_test {

const std::vector<std::string> kJoints = {"shoulder", "elbow"};

// An image of four points, and another of five.
std::string Images() {
  std::string text = "image,q1[deg],q2,bx[mm],by[mm],u,v\n";
  for (int image = 3; image < 5; ++image) {
    for (int k = 0; k < image + 1; ++k) {
      text += std::to_string(image) + ",90,.5," + std::to_string(25 * k) +
              ",50," + std::to_string(100 * k) + ",7\n";
    }
  }
  return text;
}

TEST(BoardReader, ReadsImageByImage) {
  const BoardImages images =
      ReadBoardImages(WriteFile(Images(), "board.csv"), kJoints);
  ASSERT_EQ(images.size(), 2);
  EXPECT_EQ(images.number, (std::vector<long>{3, 4}));
  EXPECT_EQ(images.row, (std::vector<long>{2, 6}));
  EXPECT_NEAR(images.q(1, 0), M_PI / 2, 1e-15);
  ASSERT_EQ(images.points[1].cols(), 5);
  EXPECT_TRUE(
      images.points[1].col(2).isApprox(Eigen::Vector3d(.05, .05, 0), 1e-12));
  EXPECT_EQ(images.pixels[1].col(4), Eigen::Vector2d(400, 7));
}

std::string MessageOfImages(const std::string& text) {
  const std::string path = WriteFile(text, "board.csv");
  return MessageOf<InputError>(path, [&] { ReadBoardImages(path, kJoints); });
}

TEST(BoardReader, RefusesMalformedFiles) {
  EXPECT_EQ(MessageOfImages(""), "FILE: the file is empty");
  EXPECT_EQ(MessageOfImages("image,q1,q2,bx,by,u,v\n"),
            "FILE: the file has a header and no rows");
  EXPECT_EQ(MessageOfImages("image,q1,q2,bx,by,u\n0,0,0,0,0,0\n"),
            "FILE: row 1: the column v is missing");
  EXPECT_EQ(MessageOfImages("q1,q2,bx,by,u,v\n0,0,0,0,0,0\n"),
            "FILE: row 1: the column image is missing");
  EXPECT_EQ(MessageOfImages("image,q1,q2,bx,by,u,v\n1,0,0,0,0,0,0\n"),
            "FILE: row 2: found '1': expected four points of an image or more");
  EXPECT_EQ(
      MessageOfImages("image,q1,q2,bx,by,u,v\n1,0,0,0,0,0,0\n1,0,1,0,0,0,0\n"),
      "FILE: row 3: expected the joint positions of the image's other rows");
  EXPECT_EQ(MessageOfImages("image,q1,q2,bx,by,u,v\n1.5,0,0,0,0,0,0\n"),
            "FILE: row 2, column image: found '1.500000': expected a whole "
            "number");
}

// Two cameras may see the board at once: one number, two images.
TEST(BoardReader, TellsCamerasApart) {
  std::string text = "image,camera,q1,q2,bx,by,u,v\n";
  for (const char* camera : {"2", "1"}) {
    for (int k = 0; k < 4; ++k) {
      text +=
          std::string("1,") + camera + ",0,0," + std::to_string(k) + ",0,0,0\n";
    }
  }
  const BoardImages images =
      ReadBoardImages(WriteFile(text, "board.csv"), kJoints);
  EXPECT_EQ(images.camera, (std::vector<int>{1, 0}));
  EXPECT_EQ(images.number, (std::vector<long>{1, 1}));
  EXPECT_EQ(MessageOfImages("image,camera,q1,q2,bx,by,u,v\n1,0,0,0,0,0,0,0\n"),
            "FILE: row 2, column camera: found '0': expected the number of a "
            "camera, 1 to 16");
}

}  // namespace armcal::board_reader_test
