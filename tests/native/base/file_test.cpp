#include "pfgeom/base/file.h"

#include "pfgeom/base/error.h"
#include "scratch_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <sys/stat.h>

namespace pfgeom {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return folder_ / name; }
    std::ptrdiff_t entries() const {
        return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator{});
    }

    ScratchFolder folder_;
};

std::vector<std::uint8_t> counting(std::size_t n) {
    std::vector<std::uint8_t> bytes(n);
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
    return bytes;
}

TEST_F(FileTest, GivesBackWhatWasWritten) {
    for (const std::size_t n : {0u, 1u, 255u, 1u << 20}) {
        write_file(path("a"), counting(n));
        EXPECT_EQ(read_file(path("a")), counting(n));
    }
    EXPECT_EQ(entries(), 1) << "temporary files are left";
}

TEST_F(FileTest, FailedWriteLeavesTheOldFileAndNothingElse) {
    fs::create_directories(path("folder/inside"));
    EXPECT_THROW(write_file(path("folder"), counting(3)), IoError);
    EXPECT_THROW(write_file(path("missing/a"), counting(3)), IoError);
    EXPECT_EQ(entries(), 1);
    EXPECT_THROW(write_file("", counting(3)), IoError);
}

TEST_F(FileTest, FullDiskIsAnErrorAndNoDeviceIsReplaced) {
    if (!fs::exists("/dev/full")) GTEST_SKIP();
    EXPECT_THROW(write_file("/dev/full", counting(3)), IoError);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(FileTest, WritesThroughSymbolicLinks) {
    write_file(path("real"), counting(1));
    fs::create_symlink(path("real"), path("link"));
    write_file(path("link"), counting(9));
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(read_file(path("real")), counting(9));
}

TEST_F(FileTest, RefusesWhatIsNotARegularFile) {
    EXPECT_THROW(read_file(path("missing")), IoError);
    EXPECT_THROW(read_file(folder_.path().string()), IoError);
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    EXPECT_THROW(read_file(path("pipe")), IoError);  // and does not wait for a writer
}

TEST_F(FileTest, RefusesLargerThanTheLimit) {
    write_file(path("a"), counting(100));
    EXPECT_THROW(read_file(path("a"), Limits{.file_bytes = 99}), IoError);
    EXPECT_EQ(read_file(path("a"), Limits{.file_bytes = 100}).size(), 100u);
}

TEST_F(FileTest, TheMessageNamesTheFileAndTheReason) {
    try {
        read_file(path("missing"));
        FAIL();
    } catch (const IoError& error) {
        EXPECT_NE(std::string(error.what()).find("missing'"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
    }
}

}  // namespace
}  // namespace pfgeom
