// SPDX-License-Identifier: MIT
#include "live/session.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "dynamic_filter/error.hpp"
#include "formats/messages/messages.hpp"
#include "live/fake_bus.hpp"
#include "support/filled_map.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::live {
namespace session_test {

using dynamic_filter::test::TemporaryFolder;
using test::FakeBus;

bool eventually(const std::function<bool()>& what) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!what()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

LiveScan live(const Scan& scan) {
    LiveScan live;
    for (const char* axis : {"x", "y", "z"}) io::add_field(live.cloud, axis, io::FieldType::f32);
    const auto* bytes = reinterpret_cast<const std::byte*>(scan.points.data());
    live.cloud.data.assign(bytes, bytes + scan.points.size() * sizeof(Point));
    live.points = scan.points;
    live.frame = "lidar";
    live.world = "map";
    live.stamp = 100.0 + scan.stamp;
    live.stamp_ns = io::to_nanoseconds(live.stamp);
    live.has_pose = true;
    live.T_world_sensor = scan.T_world_sensor;
    live.arrived = std::chrono::steady_clock::now();
    return live;
}

struct Running {
    LiveConfig config;
    FakeBus bus;
    std::optional<Outputs> outputs;
    std::optional<Session> session;
    std::size_t pushed = 0;

    Session& start(Recorder* recorder = nullptr) {
        outputs.emplace(config, bus.used, bus);
        return session.emplace(config, *outputs, recorder);
    }
    /// One after the other, as a sensor that is slow enough sends them: each is published before
    /// the next one comes.
    void push(const Scan& scan) {
        session->push(live(scan));
        ++pushed;
        eventually([&] { return session->published() == pushed && !session->is_busy(); });
    }
    void push_all(int scans) {
        for (const auto& s : dynamic_filter::test::drive(scans, true)) push(s.scan);
    }
    std::size_t count(const std::string& topic) const { return bus.published(topic).size(); }
};

TEST(Session, EveryScanIsJudgedAndPublishedInOrder) {
    Running running;
    running.start();
    running.push_all(12);
    running.session->stop();
    const auto labels = running.bus.published("/dynamicfilter/labels");
    ASSERT_EQ(labels.size(), 12U);
    std::int64_t before = 0;
    for (const Bytes& message : labels) {
        const auto cloud =
            io::read_cloud_message(*message, {"", "sensor_msgs/PointCloud2", running.bus.used});
        EXPECT_GT(cloud.header.stamp_ns, before);
        before = cloud.header.stamp_ns;
    }
    EXPECT_EQ(running.count("/dynamicfilter/static"), 12U);
    const Counters counters = running.session->counters();
    EXPECT_EQ(counters.processed, 12U);
    EXPECT_EQ(counters.queued, 0U);
    EXPECT_EQ(running.session->published(), 12U);
    EXPECT_EQ(running.session->unpublished(), 0U);
    EXPECT_EQ(running.session->latencies().scans, 12U);
}

TEST(Session, CorrectionsComeAfterTheGivenNumberOfScans) {
    Running running;
    running.config.output.settle_after = 5;
    running.start();
    running.push_all(12);
    running.session->stop();
    EXPECT_EQ(running.count("/dynamicfilter/corrections"), 7U);
}

TEST(Session, AnOccupancyGridIsPublishedToThoseWhoComeLate) {
    Running running;
    running.config.grid.rate = 10.0;
    running.config.grid.radius = 8.0;
    running.start();
    EXPECT_TRUE(running.bus.advertised.at("/dynamicfilter/occupancy").latched);
    running.push_all(40);
    eventually([&] { return running.count("/dynamicfilter/occupancy") > 0; });
    running.session->stop();
    EXPECT_GT(running.count("/dynamicfilter/occupancy"), 0U);
}

TEST(Session, GroundThatIsLostRaisesAnAlarm) {
    for (const double wrong : {0.0, 0.8}) {  // [m] by which every second pose is too high
        Running running;
        Session& session = running.start();
        for (auto& s : dynamic_filter::test::drive(60, true)) {
            if (s.scan.index % 2 == 1) s.scan.T_world_sensor.translation().z() += wrong;
            running.push(s.scan);
        }
        session.stop();
        EXPECT_EQ(session.alarm().empty(), wrong == 0.0) << session.alarm();
    }
}

TEST(Session, TheOwnBodyComesOutAsDynamic) {
    const TemporaryFolder folder;
    std::ofstream(folder / "mask.txt") << "-100 -100 -100  0 100 100\n";
    Running running;
    running.config.input.mask = (folder / "mask.txt").string();
    running.start();
    running.push_all(12);
    running.session->stop();
    const auto cloud =
        io::read_cloud_message(*running.bus.published("/dynamicfilter/labels").front(),
                               {"", "sensor_msgs/PointCloud2", running.bus.used});
    const std::vector<double> labels = io::values(cloud.cloud, *cloud.cloud.find("label"));
    const Points points = io::positions(cloud.cloud);
    std::size_t behind = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].x() >= 0.0F) continue;
        ++behind;
        EXPECT_EQ(labels[i], static_cast<double>(Label::dynamic));
    }
    EXPECT_GT(behind, 100U);
}

TEST(Session, TheLocalMapIsPublishedAtItsRate) {
    Running running;
    running.config.output.map_rate = 50.0;
    running.start();
    running.push_all(12);
    EXPECT_TRUE(eventually([&] { return running.count("/dynamicfilter/map") >= 2; }));
    running.session->set_map(0.0, 10.0);
    running.session->stop();
    const auto map = io::read_cloud_message(*running.bus.published("/dynamicfilter/map").back(),
                                            {"", "sensor_msgs/PointCloud2", running.bus.used});
    EXPECT_GT(map.cloud.size(), 100U);
    EXPECT_EQ(map.header.frame, "map");
}

TEST(Session, ScansOfAnOlderTimeBeginANewMapAndAreNamed) {
    Running running;
    running.start();
    running.push_all(6);
    running.push_all(6);
    running.session->stop();
    EXPECT_EQ(running.session->published(), 12U);
    const auto notices = running.session->pop_notices();
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_NE(notices[0].find("a new map begins"), std::string::npos);
}

TEST(Session, ARecordingHoldsWhatWasJudged) {
    const TemporaryFolder folder;
    Running running;
    Recorder recorder(folder / "out", running.bus.used, false);
    running.start(&recorder);
    running.push_all(6);
    running.push_all(6);
    running.session->stop();
    const auto folders = recorder.commit();
    ASSERT_EQ(folders.size(), 2U) << "a recording has one time";
    for (const auto& output : folders) {
        std::size_t scans = 0, poses = 0;
        io::Bag(recorder.bag_of(output)).for_each([&](const io::Message& message) {
            ++(message.topic.name == "/points" ? scans : poses);
        });
        EXPECT_EQ(scans, 6U);
        EXPECT_EQ(poses, 6U);
    }
    EXPECT_THROW(Recorder(folder / "out", running.bus.used, false), ConfigError);
    EXPECT_NO_THROW(Recorder(folder / "out", running.bus.used, true));
}

TEST(Session, AReceiverThatTakesNothingHoldsNobodyUp) {
    Running running;
    running.bus.takes = false;
    running.start();
    running.push_all(6);
    running.session->stop();
    EXPECT_EQ(running.session->published(), 6U);
    EXPECT_GE(running.outputs->not_taken(), 18U);
}

}  // namespace session_test
}  // namespace dynamic_filter::live
