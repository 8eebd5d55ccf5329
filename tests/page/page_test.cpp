// SPDX-License-Identifier: MIT
#include "page/page.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace page_test {

PageRun small_run(const std::string& name) {
    PageRun run;
    run.info["name"] = name;
    run.arrays.push_back(page_array("map-verdict", 1, std::vector<std::uint8_t>{1, 2, 0}));
    run.arrays.push_back(page_array("path-position", 3, std::vector<float>(6, 0.5F)));
    return run;
}

TEST(Page, ArraysAreDescribed) {
    const std::string text = embedded(small_run("a"), 2);
    EXPECT_NE(text.find("<script type=\"application/json\" id=\"run-2\">"), std::string::npos);
    EXPECT_NE(text.find("<script type=\"text/plain\" id=\"run-2-map-verdict\">H4sI"),  // gzip
              std::string::npos);
    EXPECT_NE(text.find(R"("path-position":{"type":"float32","columns":3,"rows":2})"),
              std::string::npos);
}

TEST(Page, NamesCannotEndTheTagThatHoldsThem) {
    const std::string text = embedded(small_run("</script><script>alert(1)<!--"), 0);
    EXPECT_EQ(text.find("alert(1)<"), std::string::npos);
    EXPECT_EQ(text.find("</script><script>alert"), std::string::npos);
    EXPECT_NE(text.find("\\u003c/script>\\u003cscript>alert(1)\\u003c!--"), std::string::npos);
}

TEST(Page, ARunMovesFromItsReportToAnotherPage) {
    if (viewer_page().empty())
        GTEST_SKIP() << "built WITHOUT THE VIEWER: script/bootstrap fetches what it needs";
    const test::TemporaryFolder folder;
    const std::string own = embedded(small_run("a"), 0);
    const auto report = folder.put("report.html", page_with({&own, 1}));
    EXPECT_EQ(run_of_report(report, 0), own);
    EXPECT_EQ(run_of_report(report, 3), embedded(small_run("a"), 3));
}

TEST(Page, InPartsItIsTheSamePage) {
    if (viewer_page().empty())
        GTEST_SKIP() << "built WITHOUT THE VIEWER: script/bootstrap fetches what it needs";
    const std::string own = embedded(small_run("a"), 0);
    const SharedPage shared = shared_page();
    std::string page = shared.with(own);
    EXPECT_LT(page.size(), 10'000U);
    const auto put = [&](const std::string& reference, const std::string& element) {
        const std::size_t at = page.find(reference);
        ASSERT_NE(at, std::string::npos) << reference;
        page.replace(at, reference.size(), element);
    };
    const auto contents = [](const std::string& file) { return file.substr(0, file.size() - 1); };
    put("<link rel=\"stylesheet\" href=\"viewer.css\">",
        "<style>" + contents(shared.style) + "</style>");
    put("<script src=\"viewer.js\"></script>", "<script>" + contents(shared.script) + "</script>");
    EXPECT_TRUE(page == page_with({&own, 1}));
    const test::TemporaryFolder folder;
    EXPECT_EQ(run_of_report(folder.put("tile.html", shared.with(own)), 0), own);
}

TEST(Page, OtherFilesAreNoReports) {
    const test::TemporaryFolder folder;
    for (const char* text : {"", "<html>", "<script type=\"application/json\" id=\"run-0\">"}) {
        EXPECT_THROW(run_of_report(folder.put("x.html", text), 0), InputError);
    }
    EXPECT_THROW(run_of_report(folder / "missing.html", 0), InputError);
}

TEST(Page, RefersToNothingOutside) {
    const std::string page(viewer_page());
    if (page.empty())
        GTEST_SKIP() << "built WITHOUT THE VIEWER: script/bootstrap fetches what it needs";
    for (const char* outside : {"src=\"http", "href=\"http", "@import", "url(http"}) {
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
    }
}

}  // namespace page_test
}  // namespace dynamic_filter::app
