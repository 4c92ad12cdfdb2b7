// Live shader work: files that change, the last good shader that goes on, and what is typed into the shader panel.
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "app/core/shader_watch.h"
#include "gui/lab_driver.h"
#include "gui/render_fixture.h"
#include "ui/icons.h"

namespace clothlab::test {
namespace {

namespace fs = std::filesystem;

const std::string start = "#version 330 core\n#include \"common/frame.glsl\"\n#include \"common/cloth.glsl\"\n";

std::string plain(const std::string& colour) {
    return start + "void main() { pixel = vec4(" + colour + ", 1.0); }\n";
}

/// As many editors save: a new file, put in the old one's place.
void save_by_rename(const fs::path& file, const std::string& text) {
    write_file(file.string() + ".new", text);
    fs::rename(file.string() + ".new", file);
}

/// The shipped shaders in a folder of their own, with one of one colour, and a renderer on them.
struct Shaders {
    Studio studio;
    TemporaryFolder folder;
    sim::Snapshot cloth = flat_cloth(4, 4);
    render::Scene scene = scene_of(cloth);

    Shaders() {
        fs::copy(shader_folder, folder.path(), fs::copy_options::recursive);
        write_file(folder / "cloth/plain.frag", plain("1.0, 0.0, 0.0"));
        scene.options.surface.shader = "plain";
    }
    fs::path file(const std::string& name) const { return folder / name; }
};

std::vector<int> rgb(const render::Image& image) {
    const std::uint8_t* p = image.pixel(image.width / 2, image.height / 2);
    return {p[0], p[1], p[2]};
}

/// The lab on shaders of its own: a copy of the shipped ones, and an empty folder for the user's.
struct ShaderLab {
    TemporaryFolder shipped, user;
    std::unique_ptr<LabDriver> driver;

    explicit ShaderLab(int width = 900, int height = 900) {
        fs::copy(checkout() / "shaders", shipped / "shaders", fs::copy_options::recursive);
        write_file(shipped / "shaders/cloth/plain.frag", plain("1.0, 0.0, 0.0"));
        ::setenv("CLOTHLAB_DATA", shipped.path().c_str(), 1);
        app::LabOptions options = LabDriver::options(width, height);
        options.user_shaders = user / "shaders";
        options.look_at_shaders_s = 0;
        driver = std::make_unique<LabDriver>("two-pins", options);
        lab().scene.look.shader = "plain";
        lab().shader_work.pause_s = 0;
        driver->settle();
    }
    ~ShaderLab() { ::unsetenv("CLOTHLAB_DATA"); }

    ui::Lab& lab() const { return driver->lab(); }
    const std::vector<ui::ShaderFault>& faults() const { return lab().shader_work.faults; }
    fs::path plain_file() const { return shipped / "shaders/cloth/plain.frag"; }
    bool lists(const std::string& name) const {
        return std::any_of(lab().shaders.begin(), lab().shaders.end(),
                           [&](const scene::ShaderDeclaration& s) { return s.name == name; });
    }
    /// The colour of the cloth's middle in the viewport's picture, over which the window shows what is wrong.
    std::vector<int> colour() const {
        const int width = lab().viewport_width, height = lab().viewport_height;
        std::vector<std::uint8_t> rgba(static_cast<std::size_t>(4 * width * height));
        glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(lab().viewport_texture));
        glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
        glBindTexture(GL_TEXTURE_2D, 0);
        const render::PixelBox& box = driver->app().draw_report().cloth_box;
        const int x = (box.min_x + box.max_x) / 2, y = height - 1 - (box.min_y + box.max_y) / 2;
        const std::uint8_t* p = &rgba[static_cast<std::size_t>(4 * (y * width + x))];
        return {p[0], p[1], p[2]};
    }
    /// Opens the panel with the cursor at the start of a line of a file.
    void edit(const fs::path& file, int line) const {
        lab().open[static_cast<std::size_t>(ui::PanelId::shader)] = true;
        lab().shader_work.go_to = ui::ShaderFault{file, line, ""};
        driver->settle();
    }
};

const std::vector red{255, 0, 0}, green{0, 255, 0};

} // namespace

TEST_CASE("While a shader's file has a mistake the last good program goes on drawing the same pixels", "[shaders]") {
    Shaders s;
    render::Renderer renderer(s.folder.path());
    const auto draw = [&] {
        renderer.draw(s.scene, s.studio.target);
        CHECK(glGetError() == GL_NO_ERROR);
        return s.studio.target.read();
    };
    const render::Image good = draw();
    CHECK(rgb(good) == std::vector{255, 0, 0});
    CHECK(renderer.shader_errors().empty());

    write_file(s.file("cloth/plain.frag"), start + "void main() {\n    pixel = nothing;\n}\n");
    CHECK(draw() == good); // nobody has said that files changed
    renderer.reload_shaders();
    CHECK(draw() == good);
    REQUIRE(renderer.shader_errors().size() == 1);
    const render::ShaderError error = renderer.shader_errors().front();
    CHECK(error.file() == s.file("cloth/plain.frag"));
    CHECK(error.line() == 5);
    CHECK(error.faults().front().text.find("nothing") != std::string::npos);
    CHECK(error.faults().front().text.find("plain.frag") == std::string::npos);
    CHECK(draw() == good);
    CHECK(renderer.shader_errors().size() == 1);

    write_file(s.file("cloth/plain.frag"), plain("0.0, 1.0, 0.0"));
    renderer.reload_shaders();
    CHECK(rgb(draw()) == std::vector{0, 255, 0});
    CHECK(renderer.shader_errors().empty());

    fs::remove(s.file("cloth/plain.frag"));
    renderer.reload_shaders();
    CHECK(rgb(draw()) == std::vector{0, 255, 0});
    REQUIRE(renderer.shader_errors().size() == 1);
    CHECK(std::string(renderer.shader_errors().front().what()).find("there is no shader \"plain\"") !=
          std::string::npos);
    s.scene.options.surface.shader = "diffuse"; // nobody draws with it any more
    renderer.reload_shaders();
    draw();
    CHECK(renderer.shader_errors().empty());
}

TEST_CASE("A mistake in an include is told with the include's own line, and every one of a text's mistakes",
          "[shaders]") {
    Shaders s;
    write_file(s.file("common/own.glsl"), "float one() { return 1.0; }\n");
    write_file(s.file("cloth/plain.frag"),
               start + "#include \"common/own.glsl\"\nvoid main() { pixel = vec4(one()); }\n");
    render::Renderer renderer(s.folder.path());
    renderer.draw(s.scene, s.studio.target);
    write_file(s.file("common/own.glsl"), "// a\n// b\nfloat one() { return none; }\nfloat two() { return also; }\n");
    renderer.reload_shaders();
    renderer.draw(s.scene, s.studio.target);
    REQUIRE(renderer.shader_errors().size() == 1);
    const std::vector<render::ShaderFault> faults = renderer.shader_errors().front().faults();
    REQUIRE(faults.size() >= 2);
    CHECK(faults.front().file == s.file("common/own.glsl"));
    CHECK(faults.front().line == 3);
    CHECK(std::any_of(faults.begin(), faults.end(), [](const render::ShaderFault& f) { return f.line == 4; }));
}

TEST_CASE("A text in place of a file's is drawn with, and the file stays as it is", "[shaders]") {
    Shaders s;
    render::Renderer renderer(s.folder.path());
    renderer.reload_shaders({{s.file("cloth/plain.frag"), plain("0.0, 0.0, 1.0")}});
    renderer.draw(s.scene, s.studio.target);
    CHECK(rgb(s.studio.target.read()) == std::vector{0, 0, 255});
    CHECK(read_file(s.file("cloth/plain.frag")) == plain("1.0, 0.0, 0.0"));
    renderer.reload_shaders(std::map<fs::path, std::string>{});
    renderer.draw(s.scene, s.studio.target);
    CHECK(rgb(s.studio.target.read()) == std::vector{255, 0, 0});
}

TEST_CASE("The first folder that has a file wins, for shaders and for what they include", "[shaders]") {
    Shaders s;
    const TemporaryFolder own;
    fs::create_directories(own / "cloth");
    write_file(own / "cloth/mine.frag", plain("0.0, 1.0, 0.0"));
    const render::ShaderFolders folders({own.path(), s.folder.path()});
    CHECK(folders.find("cloth/plain.frag") == s.file("cloth/plain.frag"));
    const std::vector<std::string> names = render::list_surface_shaders(folders);
    CHECK(std::count(names.begin(), names.end(), "mine") == 1);
    CHECK(std::count(names.begin(), names.end(), "plain") == 1);
    const std::vector<fs::path> files = render::files_of_surface(folders, "mine");
    REQUIRE(files.size() > 3);
    CHECK(files[0] == own / "cloth/mine.frag");
    CHECK(files[1] == s.file("cloth/default.vert"));
    CHECK(std::count(files.begin(), files.end(), s.file("common/frame.glsl")) == 1);

    render::Renderer renderer(folders);
    s.scene.options.surface.shader = "mine";
    renderer.draw(s.scene, s.studio.target);
    CHECK(rgb(s.studio.target.read()) == std::vector{0, 255, 0});
    write_file(own / "cloth/plain.frag", plain("0.0, 0.0, 1.0"));
    s.scene.options.surface.shader = "plain";
    renderer.draw(s.scene, s.studio.target);
    CHECK(rgb(s.studio.target.read()) == std::vector{0, 0, 255});
}

TEST_CASE("Files that are written, replaced, added or removed are seen, and nothing else is") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "cloth");
    write_file(folder / "cloth/a.frag", "one");
    app::ShaderWatch watch({folder / "not there yet", folder.path()});
    CHECK_FALSE(watch.look());
    write_file(folder / "cloth/a.frag", "two"); // as long, and maybe at the same time by the file system's clock
    CHECK(watch.look());
    CHECK_FALSE(watch.look());
    save_by_rename(folder / "cloth/a.frag", "six");
    CHECK(watch.look());
    write_file(folder / "cloth/b.frag", "new");
    CHECK(watch.look());
    fs::remove(folder / "cloth/b.frag");
    CHECK(watch.look());
    write_file(folder / "cloth/.a.frag.swp", "an editor's own");
    write_file(folder / "cloth/a.frag~", "an editor's own");
    CHECK_FALSE(watch.look());
    write_file(folder / "cloth/a.frag", "six"); // the same text
    CHECK_FALSE(watch.look());
    // Written long ago: told by its time.
    fs::last_write_time(folder / "cloth/a.frag", fs::file_time_type::clock::now() - std::chrono::hours(1));
    CHECK_FALSE(watch.look());
    write_file(folder / "cloth/a.frag", "ten");
    CHECK(watch.look());
    fs::create_directories(folder / "not there yet");
    write_file(folder / "not there yet/c.glsl", "there");
    CHECK(watch.look());
    CHECK_FALSE(watch.look_after(1e9));
}

TEST_CASE("The lab draws with a shader's file as soon as it is saved, also paused, and lists new ones") {
    const ShaderLab s(720, 450);
    REQUIRE_FALSE(s.lab().playing);
    CHECK(s.colour() == red);
    write_file(s.plain_file(), start + "void main() { pixel = vec4(0.0, 1.0\n"); // half written
    s.driver->settle();
    CHECK(s.colour() == red);
    REQUIRE_FALSE(s.faults().empty());
    CHECK(s.faults().front().file == s.plain_file());
    CHECK(s.lab().messages.empty()); // it goes away by itself, so it is no message
    save_by_rename(s.plain_file(), plain("0.0, 1.0, 0.0"));
    s.driver->settle();
    CHECK(s.colour() == green);
    CHECK(s.faults().empty());

    write_file(s.shipped / "shaders/cloth/new.frag", plain("0.0, 0.0, 1.0"));
    s.driver->settle();
    CHECK(s.lists("new"));
    fs::remove(s.shipped / "shaders/cloth/new.frag");
    s.driver->settle();
    CHECK_FALSE(s.lists("new"));
}

TEST_CASE("A shader that has never been right can be chosen and mended, and the one before it draws meanwhile") {
    const ShaderLab s(720, 450);
    write_file(s.shipped / "shaders/cloth/wrong.frag", start + "\nvoid main() { pixel = wrong(); }\n");
    s.lab().scene.look.shader = "wrong";
    s.driver->settle();
    CHECK(s.colour() == red);
    CHECK(s.lab().scene.look.shader == "wrong");
    REQUIRE_FALSE(s.faults().empty());
    CHECK(s.faults().front().line == 5);
    CHECK(s.lab().shader_work.files.front().name == "cloth/wrong.frag");
    write_file(s.shipped / "shaders/cloth/wrong.frag", plain("0.0, 1.0, 0.0"));
    s.driver->settle();
    CHECK(s.colour() == green);
    CHECK(s.faults().empty());
}

TEST_CASE("A mistake in a declaration is told with its line, and the sliders stay") {
    const ShaderLab s(720, 450);
    const auto shader = [](const std::string& parameter) {
        return start + "uniform float part = 1.0; //@ " + parameter +
               "\nvoid main() { pixel = vec4(part, 0.0, 0.0, 1.0); }\n";
    };
    write_file(s.plain_file(), shader("label=\"Part\" min=0 max=1"));
    s.driver->settle();
    REQUIRE(ui::shader_in_use(s.lab())->find("part") != nullptr);
    write_file(s.plain_file(), shader("label=\"Part\" least=0 max=1"));
    s.driver->settle();
    REQUIRE(s.faults().size() == 1);
    CHECK(s.faults().front().file == s.plain_file());
    CHECK(s.faults().front().line == 4);
    CHECK(s.faults().front().text.find("least") != std::string::npos);
    CHECK(ui::shader_in_use(s.lab())->find("part") != nullptr);
    CHECK(s.colour() == red);
    write_file(s.plain_file(), shader("label=\"Part\" min=0 max=1"));
    s.driver->settle();
    CHECK(s.faults().empty());
}

TEST_CASE("What is typed into the shader panel changes the picture, and Ctrl+S saves it as the user's own") {
    const ShaderLab s;
    const scene::Scene before = s.lab().scene;
    const std::string shipped = read_file(s.plain_file());
    s.edit(s.plain_file(), 4);
    REQUIRE(s.driver->act([](ImGuiTestContext* user) {
        user->KeyPress(ImGuiKey_End);
        user->KeyChars(" // nrwf p"); // keys of the lab, and here letters
        for (const ImGuiKey key : {ImGuiKey_Minus, ImGuiKey_Equal, ImGuiKey_M, ImGuiKey_LeftBracket, ImGuiKey_Period})
            user->KeyPress(key);
        user->KeyPress(ImGuiKey_Home);
        user->KeyChars("#define vec4(r,g,b,a) vec4(g,r,b,a)");
        user->KeyPress(ImGuiKey_Enter);
    }));
    CHECK(s.colour() == green);
    CHECK(s.lab().scene == before);
    CHECK(s.lab().snapshot->steps == 0);
    CHECK(s.lab().speed == 1);
    CHECK(s.lab().timeline.overview->bookmarks.empty());
    CHECK_FALSE(s.lab().timeline.loop);
    CHECK(ui::has_unsaved_shaders(s.lab()));
    CHECK(read_file(s.plain_file()) == shipped);
    CHECK_FALSE(fs::exists(s.user / "shaders"));

    // Another shader, and back: nothing is lost.
    s.lab().scene.look.shader = "diffuse";
    s.driver->settle();
    CHECK(ui::has_unsaved_shaders(s.lab()));
    s.lab().scene.look.shader = "plain";
    s.driver->settle();
    CHECK(s.colour() == green);

    s.edit(s.plain_file(), 4);
    REQUIRE(s.driver->act([](ImGuiTestContext* user) { user->KeyPress(ImGuiMod_Ctrl | ImGuiKey_S); }));
    CHECK_FALSE(ui::has_unsaved_shaders(s.lab()));
    CHECK(s.colour() == green);
    CHECK(read_file(s.plain_file()) == shipped);
    const std::string saved = read_file(s.user / "shaders/cloth/plain.frag");
    CHECK(saved.find("#define vec4(r,g,b,a) vec4(g,r,b,a)\nvoid main()") != std::string::npos);
    CHECK(s.lab().shader_work.notice.find("copy") != std::string::npos);
    CHECK(s.lab().messages.empty());
    CHECK(s.lab().file == app::scene_path("two-pins")); // the scene was not saved

    // Back to the shipped file; the copy is kept beside.
    REQUIRE(s.driver->act([](ImGuiTestContext* user) { user->ItemClick("###Shader/**/Use the shipped file"); }));
    CHECK(s.colour() == red);
    CHECK(read_file(s.user / "shaders/cloth/plain.frag~") == saved);
}

TEST_CASE("A mistake that is typed is shown over the picture, and undo takes it back") {
    const ShaderLab s;
    s.edit(s.plain_file(), 4);
    REQUIRE(s.driver->act([](ImGuiTestContext* user) { user->KeyChars("oops "); }));
    REQUIRE_FALSE(s.faults().empty());
    CHECK(s.faults().front().line == 4);
    CHECK(s.colour() == red);
    REQUIRE(s.driver->act([](ImGuiTestContext* user) { user->ItemClick("###Viewport/**/Show"); }));
    REQUIRE(s.driver->act([](ImGuiTestContext* user) { user->KeyPress(ImGuiMod_Ctrl | ImGuiKey_Z, 5); }));
    CHECK(s.faults().empty());
    CHECK_FALSE(ui::has_unsaved_shaders(s.lab()));
}

TEST_CASE("A new shader from this one is chosen, listed and drawn with") {
    const ShaderLab s;
    s.edit(s.plain_file(), 1);
    REQUIRE(s.driver->act([](ImGuiTestContext* user) {
        user->ItemClick("###Shader/**/" ICON_FA_COPY "  New shader ...");
        user->Yield(3);
        user->SetRef("//$FOCUSED");
        user->ItemInputValue("##name", "mine");
    }));
    CHECK(s.lab().scene.look.shader == "mine");
    CHECK(s.lists("mine"));
    CHECK(read_file(s.user / "shaders/cloth/mine.frag") == read_file(s.plain_file()));
    CHECK(s.colour() == red);
    s.lab().ask(ui::CopyShader{"plain", "../elsewhere"});
    s.lab().ask(ui::CopyShader{"plain", "diffuse"});
    s.driver->settle();
    CHECK(s.lab().messages.size() == 2);
    CHECK(s.lab().scene.look.shader == "mine");
}

TEST_CASE("A file that others change while it is edited loses neither text") {
    const ShaderLab s;
    s.edit(s.plain_file(), 1);
    write_file(s.plain_file(), plain("0.0, 1.0, 0.0")); // not edited yet: followed
    s.driver->settle();
    CHECK(s.colour() == green);
    CHECK_FALSE(ui::has_unsaved_shaders(s.lab()));
    s.edit(s.plain_file(), 4);
    REQUIRE(s.driver->act([](ImGuiTestContext* user) {
        user->KeyChars("#define unused");
        user->KeyPress(ImGuiKey_Enter);
    }));
    write_file(s.plain_file(), plain("1.0, 0.0, 0.0"));
    s.driver->settle();
    CHECK(s.colour() == green);
    CHECK(ui::has_unsaved_shaders(s.lab()));
    REQUIRE(
        s.driver->act([](ImGuiTestContext* user) { user->ItemClick("###Shader/**/" ICON_FA_ROTATE_LEFT "  Revert"); }));
    CHECK(s.colour() == red);
    CHECK_FALSE(ui::has_unsaved_shaders(s.lab()));
}

TEST_CASE("The lab asks before it is closed with unsaved shaders") {
    const ShaderLab s;
    s.edit(s.plain_file(), 1);
    REQUIRE(s.driver->act([](ImGuiTestContext* user) {
        user->KeyPress(ImGuiKey_End);
        user->KeyPress(ImGuiKey_Enter);
        user->KeyChars("// mine");
    }));
    s.lab().ask(ui::Quit{});
    s.driver->settle();
    REQUIRE(s.driver->act([](ImGuiTestContext* user) { user->ItemClick("//$FOCUSED/Cancel"); }));
    CHECK(s.driver->app().frame());
    CHECK(ui::has_unsaved_shaders(s.lab()));

    write_file(s.user / "shaders", "no folder"); // saving fails: the lab stays, and so does the text
    s.lab().ask(ui::Quit{});
    s.driver->settle();
    REQUIRE(s.driver->act([](ImGuiTestContext* user) { user->ItemClick("//$FOCUSED/###save"); }));
    CHECK(s.driver->frame());
    CHECK(ui::has_unsaved_shaders(s.lab()));
    REQUIRE(s.lab().messages.size() == 1);
    CHECK(s.lab().messages.front().error);

    fs::remove(s.user / "shaders");
    s.driver->act([](ImGuiTestContext* user) { user->ItemClick("//$FOCUSED/###save"); });
    CHECK_FALSE(s.driver->frame());
    CHECK(read_file(s.user / "shaders/cloth/plain.frag").find("#version 330 core\n// mine\n") == 0);
}

} // namespace clothlab::test
