// Pictures and recordings that the lab makes.
#include <imgui.h>

#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <fstream>

#include "app/gui/film.h"
#include "app/gui/picture_sequence.h"
#include "app/pictures.h"
#include "cli/gui/gui_commands.h"
#include "lab_driver.h"
#include "small_scene.h"
#include "ui/icons.h"

namespace clothlab::test {
namespace {

namespace fs = std::filesystem;

/// The lab on a small scene, and a folder for what it writes.
struct Set {
    TemporaryFolder folder;
    LabDriver driver{small_scene(folder).string(), 480, 300};
    ui::Output& output = driver.lab().output;

    explicit Set(int width = 48, int height = 36) {
        output.as_viewport = false;
        output.width = width;
        output.height = height;
        output.picture_file = path("picture.png");
        output.film_file = path("film.mp4");
        output.sequence_file = path("frame-%04d.png");
        output.film = false;
        output.seconds = 0;
        output.fps = 90; // every frame
    }
    std::string path(const std::string& name) const { return (folder / name).string(); }
    int files() const {
        int count = 0;
        for (const auto& entry : fs::directory_iterator(folder.path()))
            count += entry.path().extension() != ".json";
        return count;
    }
    /// Begins a recording and lets it make so many pictures.
    void record(int pictures) {
        driver.lab().ask(ui::Record{});
        driver.frame();
        while (driver.lab().output.recording && driver.lab().output.recording->pictures < pictures)
            driver.frame();
    }
    /// Until the recording has ended by itself.
    void record_all() {
        driver.lab().ask(ui::Record{});
        driver.frame();
        while (driver.lab().output.recording)
            driver.frame();
    }
    std::string message() const { return driver_messages().empty() ? "" : driver_messages().back().text; }
    bool told(const char* part) const { return message().find(part) != std::string::npos; }

private:
    const std::deque<ui::Message>& driver_messages() const { return const_cast<Set*>(this)->driver.lab().messages; }
};

/// Another PATH for as long as this lives.
class Path {
public:
    explicit Path(const std::string& path) : before_(std::getenv("PATH")) { ::setenv("PATH", path.c_str(), 1); }
    ~Path() { ::setenv("PATH", before_.c_str(), 1); }
    Path(const Path&) = delete;
    Path& operator=(const Path&) = delete;

private:
    std::string before_;
};

/// A program that is found as ffmpeg. In its script $file is what it is to write.
std::string fake_ffmpeg(const TemporaryFolder& folder, const std::string& script) {
    const fs::path bin = folder / "bin.json"; // so that it is not counted
    fs::create_directory(bin);
    std::ofstream(bin / "ffmpeg") << "#!/bin/sh\nfor last; do :; done\nfile=\"${last#file:}\"\n" << script << "\n";
    fs::permissions(bin / "ffmpeg", fs::perms::owner_all);
    return bin.string() + ":/usr/bin:/bin";
}
constexpr const char* keeps_raw_pictures = "cat > \"$file\"";

/// The frames of the small scene as `clothlab render` draws them.
std::vector<render::Image> rendered(const Set& set, int frames) {
    const TemporaryFolder folder;
    cli::RenderArguments arguments;
    arguments.scene.scene = set.path("small.json");
    arguments.width = set.output.width;
    arguments.height = set.output.height;
    arguments.frame = frames - 1;
    arguments.output = (folder / "frame-%d.png").string();
    REQUIRE(cli::gui_commands().render(arguments) == 0);
    std::vector<render::Image> pictures;
    for (int i = 0; i < frames; ++i)
        pictures.push_back(render::read_png(folder / ("frame-" + std::to_string(i) + ".png")));
    return pictures;
}

} // namespace

TEST_CASE("The Output window saves a picture of any size, larger than the viewport too") {
    Set set;
    REQUIRE(set.driver.act([&](ImGuiTestContext* user) {
        user->KeyPress(ImGuiMod_Shift | ImGuiKey_F12);
        user->SetRef("###Output");
        user->ItemInputValue("##size/$$0", 1000);
        user->ItemInputValue("##size/$$1", 640);
        user->ItemInputValue("picture/##file", set.path("large").c_str());
        user->ItemClick("picture/###save");
    }));
    const render::Image picture = render::read_png(set.path("large.png"));
    CHECK(picture.width == 1000);
    CHECK(picture.height == 640);
    CHECK(set.driver.lab().viewport_width < 500);
    CHECK(set.told("large.png"));
    // The same as `clothlab render` makes of that size.
    set.output.width = 1000;
    set.output.height = 640;
    CHECK(rendered(set, 1).front() == picture);
}

TEST_CASE("F12 saves under the next free name, and no picture replaces a file that is not meant") {
    Set set;
    std::ofstream(set.path("picture.png")) << "precious";
    REQUIRE(set.driver.act([](ImGuiTestContext* user) {
        user->KeyPress(ImGuiKey_F12);
        user->KeyPress(ImGuiKey_F12);
    }));
    CHECK(fs::exists(set.path("picture-0001.png")));
    CHECK(fs::exists(set.path("picture-0002.png")));
    set.driver.lab().ask(ui::TakePicture{set.path("picture.png"), false});
    set.driver.settle();
    CHECK(set.told("exists"));
    CHECK(read_file(set.path("picture.png")) == "precious");
    // In the window the button says so before it does it.
    set.output.open = true;
    set.output.picture_file = set.path("picture.png");
    set.driver.settle();
    CHECK(set.output.picture_objection.find("would be replaced") != std::string::npos);
    REQUIRE(set.driver.act([](ImGuiTestContext* user) { user->ItemClick("###Output/picture/###save"); }));
    CHECK(render::read_png(set.path("picture.png")).width == 48);
}

TEST_CASE("A transparent picture has no background, and looks over white as if it had been drawn over white") {
    Set set(200, 150);
    set.driver.app().show_frame(30);
    set.output.transparent = true;
    set.driver.lab().ask(ui::TakePicture{});
    set.driver.settle();
    const render::Image picture = render::read_png(set.path("picture.png"));
    CHECK(picture.pixel(1, 1)[3] == 0);
    CHECK(picture.pixel(198, 1)[3] == 0);
    CHECK(picture.pixel(100, 70)[3] == 255);
    int partly = 0, dark = 0;
    for (int y = 0; y < picture.height / 2; ++y) // above the floor, if there is one
        for (int x = 0; x < picture.width; ++x) {
            const std::uint8_t* p = picture.pixel(x, y);
            if (p[3] == 0 || p[3] == 255)
                continue;
            ++partly;
            // A rim that had been mixed with black would have less than half of the cloth's own red.
            dark += p[0] < 80;
        }
    CHECK(partly > 30);
    CHECK(dark == 0);
}

TEST_CASE("Black and white backgrounds tell colour and coverage apart") {
    render::Image black{3, 1, {}}, white{3, 1, {}};
    black.rgba = {0, 0, 0, 255, 200, 100, 50, 255, 50, 25, 0, 255};
    white.rgba = {255, 255, 255, 255, 200, 100, 50, 255, 241, 216, 191, 255};
    const render::Image picture = render::transparent(black, white);
    CHECK(picture.pixel(0, 0)[3] == 0);
    CHECK(std::vector<int>(picture.pixel(1, 0), picture.pixel(1, 0) + 4) == std::vector<int>{200, 100, 50, 255});
    CHECK(std::vector<int>(picture.pixel(2, 0), picture.pixel(2, 0) + 4) == std::vector<int>{199, 100, 0, 64});
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const int alpha = picture.pixel(i, 0)[3],
                      over_white = (picture.pixel(i, 0)[k] * alpha + 255 * (255 - alpha)) / 255;
            CHECK(std::abs(over_white - white.pixel(i, 0)[k]) <= 1);
        }
}

TEST_CASE("A picture with the panels is the window, without the Output window that asked for it") {
    Set set;
    set.output.open = true;
    set.output.with_panels = true;
    REQUIRE(set.driver.act([](ImGuiTestContext* user) { user->ItemClick("###Output/picture/###save"); }));
    CHECK(set.output.open);
    set.output.open = false;
    set.driver.lab().messages.clear();
    set.driver.settle();
    const render::Image picture = render::read_png(set.path("picture.png"));
    CHECK(picture.width == 480);
    CHECK(render::difference(picture, set.driver.app().picture()) < 0.002);
    set.output.open = true;
    set.driver.settle();
    CHECK(render::difference(picture, set.driver.app().picture()) > 0.01);
}

TEST_CASE("A recording has every frame once, in order, as `render` draws them, whatever the screen did") {
    Set set;
    set.driver.app().simulation().play(true); // from the start is from the start
    set.output.seconds = 100 / 90.0;
    set.record_all();
    CHECK(set.files() == 100);
    CHECK(set.told("Recorded 100 pictures"));
    const std::vector<render::Image> expected = rendered(set, 100);
    int wrong = 0, same = 0;
    for (int i = 0; i < 100; ++i) {
        char name[24];
        std::snprintf(name, sizeof name, "frame-%04d.png", i);
        wrong += render::read_png(set.path(name)) != expected[static_cast<std::size_t>(i)];
        same += i > 0 && expected[static_cast<std::size_t>(i)] == expected[static_cast<std::size_t>(i - 1)];
    }
    CHECK(wrong == 0);
    CHECK(same == 0);
    CHECK(set.driver.lab().snapshot->frame == 99);
}

TEST_CASE("A film takes as many frames as show the chosen speed, and its pictures reach ffmpeg whole") {
    Set set(31, 17); // odd: for ffmpeg to make even
    const Path path(fake_ffmpeg(set.folder, keeps_raw_pictures));
    set.output.film = true;
    set.output.fps = 30;
    set.output.seconds = 0.2;
    set.record_all();
    CHECK(set.told("Recorded 6 pictures"));
    const std::string film = read_file(set.path("film.mp4"));
    const std::size_t size = 31 * 17 * 4;
    REQUIRE(film.size() == 6 * size);
    CHECK_FALSE(fs::exists(set.path("film.mp4.part")));
    const std::vector<render::Image> expected = rendered(set, 16);
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(std::equal(expected[3 * i].rgba.begin(), expected[3 * i].rgba.end(),
                         reinterpret_cast<const std::uint8_t*>(film.data() + i * size)));
}

TEST_CASE("Space pauses a recording, steps by hand are not taken, Stop keeps and Cancel removes it") {
    Set set;
    set.record(3);
    REQUIRE(set.driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_Space); }));
    REQUIRE(set.output.recording);
    CHECK(set.output.recording->paused);
    CHECK_FALSE(set.driver.lab().playing);
    const int pictures = set.output.recording->pictures;
    REQUIRE(set.driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_N); }));
    CHECK(set.output.recording->pictures == pictures);
    CHECK(set.driver.lab().snapshot->frame <= static_cast<std::uint64_t>(pictures));
    set.output.open = true;
    REQUIRE(set.driver.act([](ImGuiTestContext* user) {
        user->ItemClick("###Output/recording/###pause");
        user->ItemClick("###Output/recording/###stop");
    }));
    CHECK_FALSE(set.output.recording);
    const int kept = set.files();
    CHECK(kept >= pictures);
    CHECK(set.told("Recorded"));

    set.output.sequence_file = set.path("other-%d.png");
    set.record(2);
    CHECK(set.files() > kept);
    REQUIRE(set.driver.act([](ImGuiTestContext* user) { user->ItemClick("###Output/recording/###cancel"); }));
    CHECK(set.files() == kept);
    CHECK(set.told("cancelled"));
}

TEST_CASE("A recording ends with the run it is of, and says why") {
    Set set;
    set.record(3);
    REQUIRE(set.driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_R); }));
    CHECK_FALSE(set.output.recording);
    CHECK(set.told("started anew"));
    CHECK(set.files() >= 3);

    set.output.sequence_file = set.path("blown-up-%d.png");
    set.driver.lab().scene.simulation.cloth.ks = 1e9;
    set.driver.lab().scene.simulation.rules.limit = sim::LimitRule::off;
    set.driver.settle();
    set.record_all();
    CHECK(set.told("too stiff"));
    CHECK(fs::exists(set.path("blown-up-0.png")));
}

TEST_CASE("Without ffmpeg the lab says which package it needs, and still records PNG pictures") {
    Set set;
    const Path nothing("");
    set.output.open = true;
    set.output.film = true;
    set.driver.settle();
    CHECK_FALSE(set.output.has_ffmpeg);
    set.driver.lab().ask(ui::Record{});
    set.driver.settle();
    CHECK(set.told("package ffmpeg"));
    CHECK(set.files() == 0);
    set.output.film = false;
    set.output.seconds = 2 / 90.0;
    set.record_all();
    CHECK(set.files() == 2);
}

TEST_CASE("A film that ffmpeg gives up is reported with ffmpeg's reason, and the lab goes on") {
    Set set;
    const Path path(
        fake_ffmpeg(set.folder, "head -c 20000 >\"$file\"\necho 'av_write: No space left on device' >&2\nexit 1"));
    set.output.film = true;
    set.record_all();
    CHECK(set.told("film.mp4: ffmpeg stopped before the film was complete: av_write: No space left on device"));
    CHECK(set.files() == 0);
    REQUIRE(set.driver.act([](ImGuiTestContext* user) { user->KeyPress(ImGuiKey_R); }));
    CHECK(set.driver.lab().snapshot->frame == 0);
}

TEST_CASE("A full disk ends a sequence with a sentence and keeps what fits") {
    if (!fs::exists("/dev/full"))
        SKIP("this system has no /dev/full");
    Set set;
    set.record(2);
    char name[24];
    std::snprintf(name, sizeof name, "frame-%04d.png", set.output.recording->pictures + 1);
    fs::create_symlink("/dev/full", set.path(name));
    while (set.output.recording)
        set.driver.frame();
    CHECK(set.told("No space left on device"));
    CHECK(set.told(name));
    CHECK(render::read_png(set.path("frame-0001.png")).width == 48);
}

TEST_CASE("Recordings replace nothing unless they are told to") {
    Set set;
    std::ofstream(set.path("frame-0007.png")) << "precious";
    set.output.open = true;
    set.driver.settle();
    CHECK(set.output.recording_objection.find("1 picture of this name exist") == 0);
    set.driver.lab().ask(ui::Record{});
    set.driver.settle();
    CHECK(set.told("exists"));
    CHECK(set.files() == 1);
    CHECK(read_file(set.path("frame-0007.png")) == "precious");
}

TEST_CASE("A film that is under way when the lab is closed is finished properly") {
    const TemporaryFolder folder;
    const Path path(fake_ffmpeg(folder, keeps_raw_pictures));
    int pictures = 0;
    {
        Set set;
        set.output.film = true;
        set.output.film_file = (folder / "film.mp4").string();
        set.record(4);
        pictures = set.output.recording->pictures;
    }
    CHECK(fs::file_size(folder / "film.mp4") == static_cast<std::size_t>(pictures) * 48 * 36 * 4);
    CHECK_FALSE(fs::exists(folder / "film.mp4.part"));
}

TEST_CASE("Names of sequences have one place for the number, and free names are found") {
    CHECK(app::SequenceName("a/b-%04d.png").picture(7) == fs::path("a/b-0007.png"));
    CHECK(app::SequenceName("%d.png").picture(12345) == fs::path("12345.png"));
    for (const char* bad : {"a.png", "a-%d-%d.png", "a-%s.png", "a-%%d.png", "%d/a-%d.png"})
        CHECK_THROWS_AS(app::SequenceName(bad), std::runtime_error);
    const TemporaryFolder folder;
    const auto free = [&](const std::string& name) {
        return fs::path(app::free_name((folder / name).string())).filename().string();
    };
    CHECK(free("a.png") == "a.png");
    for (const char* name : {"a.png", "a-0001.png", "b-0099.mp4", "c-0001-0003.png"})
        std::ofstream((folder / name).string()) << "x";
    CHECK(free("a.png") == "a-0002.png");
    CHECK(free("a-0001.png") == "a-0002.png");
    CHECK(free("b-0099.mp4") == "b-0100.mp4");
    CHECK(free("c-0001-%04d.png") == "c-0002-%04d.png");
}

TEST_CASE("The pace of a film is as near to the wished one as whole frames allow, at the right speed") {
    ui::Output o;
    const auto check = [&](int fps, double speed, int every, double rate) {
        o.fps = fps;
        o.speed = speed;
        const ui::Pace pace = ui::pace(o, 90);
        CHECK(pace.every == every);
        CHECK(pace.rate == rate);
        CHECK(pace.pictures == static_cast<int>(std::lround(o.seconds * rate)));
    };
    check(30, 1, 3, 30);
    check(60, 1, 2, 45);
    check(30, 2, 6, 30);
    check(60, 0.5, 1, 45);
    check(30, 1.0 / 16, 1, 90.0 / 16); // nothing lies between two frames
    o.seconds = 0;
    check(30, 4, 12, 30);
}

} // namespace clothlab::test
