// Where data files are looked for, and in which order.
#include "core/data_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/error.h"
#include "support/process.h"

namespace tarn::test {
namespace {

namespace fs = std::filesystem;

class DataFiles : public testing::Test {
  protected:
    void SetUp() override { unsetenv("TARN_TEST_DIR"); }
    void TearDown() override {
        unsetenv("TARN_TEST_DIR");
        set_data_root({});
    }

    // The file "a" in `folder`, under the test's own folder.
    fs::path write(const std::string& folder) {
        const fs::path file = temporary_.path() / folder / "a";
        fs::create_directories(file.parent_path());
        std::ofstream(file) << folder;
        return file;
    }

    TemporaryFolder temporary_;
    std::string built_ = temporary_.file("built");
    DataFolder folder_{"test_data", "TARN_TEST_DIR", built_.c_str()};
};

TEST_F(DataFiles, ThePlacesStandInTheOrderOfTheSearch) {
    set_data_root("/installed/share/tarn");
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
    const std::vector<fs::path> expected = {program / "test_data",
                                            program.parent_path() / "share" / "tarn" / "test_data",
                                            "/installed/share/tarn/test_data", built_};
    EXPECT_EQ(list_data_places(folder_), expected);
}

TEST_F(DataFiles, TheFirstPlaceThatHoldsTheFileWins) {
    EXPECT_EQ(find_data_file(folder_, "a"), std::nullopt);
    const fs::path built = write("built");
    EXPECT_EQ(find_data_file(folder_, "a"), built);
    const fs::path installed = write("root/test_data");
    set_data_root(temporary_.path() / "root");
    EXPECT_EQ(find_data_file(folder_, "a"), installed);
    EXPECT_EQ(locate_data_file(folder_, "a"), installed);
}

TEST_F(DataFiles, WhereTheVariableIsSetNothingElseIsLookedAt) {
    write("built");
    setenv("TARN_TEST_DIR", temporary_.file("chosen").c_str(), 1);
    EXPECT_EQ(find_data_file(folder_, "a"), std::nullopt);
    const fs::path chosen = write("chosen");
    EXPECT_EQ(locate_data_file(folder_, "a"), chosen);
    setenv("TARN_TEST_DIR", "", 1);
    EXPECT_EQ(locate_data_file(folder_, "a"), fs::path(built_) / "a");
}

TEST_F(DataFiles, AMissingFileIsOneLineWithAllPlaces) {
    try {
        locate_data_file(folder_, "a");
        FAIL() << "found";
    } catch (const Error& error) {
        const std::string text = error.what();
        for (const fs::path& place : list_data_places(folder_)) {
            EXPECT_NE(text.find(place.string()), std::string::npos) << text;
        }
        EXPECT_NE(text.find("TARN_TEST_DIR"), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace tarn::test
