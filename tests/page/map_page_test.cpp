// SPDX-License-Identifier: MIT
#include "page/map_page.hpp"

#include <gtest/gtest.h>

#include <map>

#include "dynamic_filter/error.hpp"
#include "page/page.hpp"
#include "support/sample_map.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace map_page_test {

namespace fs = std::filesystem;

class MapPage : public testing::Test {
protected:
    void SetUp() override {
        if (viewer_page().empty())
            GTEST_SKIP() << "built WITHOUT THE VIEWER: script/bootstrap fetches what it needs";
    }
    /// All files of the report.
    static std::map<std::string, std::string> report_of(const fs::path& out) {
        write_map_page(out, {{"tiles", 19}}, nullptr,
                       {{"drive_1", {{0, 0, 0}, {10, 0, 0}}}, {"drive_2", {}}});
        std::map<std::string, std::string> files{{"report.html", test::slurp(out / "report.html")}};
        for (const auto& entry : fs::directory_iterator(out / "report"))
            files[entry.path().filename()] = test::slurp(entry.path());
        return files;
    }
    static nlohmann::json info_of(const std::string& page) {
        const std::string open = "id=\"run-0\">";
        const std::size_t begin = page.find(open) + open.size();
        return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    }
    test::TemporaryFolder folder_;
};

TEST_F(MapPage, HasAnOverviewAndAPageForEachTile) {
    const MapIndex index = write_sample_map(folder_.path());
    auto files = report_of(folder_.path());
    EXPECT_EQ(files.size(), index.tiles.size() + 3);
    const nlohmann::json overview = info_of(files["report.html"]);
    EXPECT_EQ(overview["kind"], "city");
    ASSERT_EQ(overview["tiles"].size(), index.tiles.size());
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < index.tiles.size(); ++i) {
        EXPECT_EQ(overview["tiles"][i]["name"], index.tiles[i].name);
        EXPECT_EQ(overview["tiles"][i]["voxels"], index.tiles[i].voxels);
        EXPECT_GE(overview["tiles"][i]["drives"].size(), 2U);
        const std::size_t edge = overview["tiles"][i]["edge"];
        pixels += edge * edge;
        const nlohmann::json page = info_of(files[index.tiles[i].name + ".html"]);
        EXPECT_EQ(page["kind"], "tile");
        EXPECT_EQ(page["tile"]["overview"], "../report.html");
    }
    EXPECT_EQ(overview["arrays"]["tile-picture"]["rows"], pixels);
    EXPECT_EQ(overview["arrays"]["track-begin"]["rows"], 3);
    EXPECT_EQ(overview["scores"]["tiles"], 19);
}

TEST_F(MapPage, ThePagesOfTilesShareTheViewer) {
    write_sample_map(folder_.path());
    auto files = report_of(folder_.path());
    EXPECT_GT(files["viewer.js"].size(), 400'000U);
    for (const auto& [name, text] : files) {
        if (!name.ends_with(".html") || name == "report.html") continue;
        EXPECT_LT(text.size(), 200'000U) << name;
        EXPECT_NE(text.find("<script src=\"viewer.js\"></script>"), std::string::npos) << name;
        EXPECT_NE(text.find("href=\"viewer.css\""), std::string::npos) << name;
    }
}

TEST_F(MapPage, TheSameMapGivesTheSameBytesInAnyFolder) {
    write_sample_map(folder_ / "a");
    write_sample_map(folder_ / "b");
    EXPECT_EQ(report_of(folder_ / "a"), report_of(folder_ / "b"));
}

TEST_F(MapPage, AMissingTileIsAnError) {
    write_sample_map(folder_.path());
    fs::remove(folder_ / "map/1_0_0.pcd");
    EXPECT_THROW(report_of(folder_.path()), InputError);
}

TEST_F(MapPage, AMapWithoutTilesHasAnOverview) {
    fs::create_directories(folder_ / "map");
    write_map_index(folder_ / "map", {});
    EXPECT_EQ(report_of(folder_.path()).size(), 3U);
}

}  // namespace map_page_test
}  // namespace dynamic_filter::app
