// Undo and redo.
#include "app/core/history.h"

#include <catch2/catch_test_macros.hpp>

#include "sim/random.h"

using namespace clothlab;

namespace {

scene::Scene scene_named(const std::string& name) {
    scene::Scene scene;
    scene.name = name;
    return scene;
}

} // namespace

TEST_CASE("A new history has nothing to undo or redo") {
    app::History history;
    REQUIRE_FALSE(history.can_undo());
    REQUIRE_FALSE(history.undo());
    history.restart(scene_named("a"));
    REQUIRE_FALSE(history.can_undo());
    REQUIRE_FALSE(history.can_redo());
    REQUIRE_FALSE(history.undo());
    REQUIRE_FALSE(history.redo());
}

TEST_CASE("Undo gives back the scene before each edit, and redo the one after it") {
    app::History history;
    history.restart(scene_named("a"));
    history.settle(scene_named("b"));
    history.settle(scene_named("b")); // no edit
    history.settle(scene_named("c"));
    REQUIRE(history.undo() == scene_named("b"));
    REQUIRE(history.can_redo());
    REQUIRE(history.undo() == scene_named("a"));
    REQUIRE_FALSE(history.can_undo());
    REQUIRE_FALSE(history.undo());
    REQUIRE(history.redo() == scene_named("b"));
    REQUIRE(history.redo() == scene_named("c"));
    REQUIRE_FALSE(history.redo());
}

TEST_CASE("Settling on what undo gave back is no edit") {
    app::History history;
    history.restart(scene_named("a"));
    history.settle(scene_named("b"));
    history.settle(*history.undo());
    REQUIRE(history.can_redo());
    REQUIRE_FALSE(history.can_undo());
}

TEST_CASE("A new edit forgets what was undone") {
    app::History history;
    history.restart(scene_named("a"));
    history.settle(scene_named("b"));
    history.undo();
    history.settle(scene_named("c"));
    REQUIRE_FALSE(history.can_redo());
    REQUIRE(history.undo() == scene_named("a"));
    REQUIRE(history.redo() == scene_named("c"));
}

TEST_CASE("Moving the camera is no edit") {
    app::History history;
    history.restart(scene_named("a"));
    scene::Scene scene = scene_named("a");
    scene.camera = scene::Camera{.yaw = 77};
    history.settle(scene);
    REQUIRE_FALSE(history.can_undo());
    scene.look.show_pins = false; // but this is one
    history.settle(scene);
    REQUIRE(history.can_undo());
    history.undo();
    scene = scene_named("a");
    scene.camera = scene::Camera{.yaw = 78};
    history.settle(scene);
    REQUIRE(history.can_redo()); // moving the camera forgets nothing
}

TEST_CASE("A restart forgets everything") {
    app::History history;
    history.restart(scene_named("a"));
    history.settle(scene_named("b"));
    history.settle(scene_named("c"));
    history.undo();
    history.restart(scene_named("d"));
    REQUIRE_FALSE(history.can_undo());
    REQUIRE_FALSE(history.can_redo());
    history.settle(scene_named("e"));
    REQUIRE(history.undo() == scene_named("d"));
}

TEST_CASE("The last two hundred edits can be undone") {
    app::History history;
    history.restart(scene_named("0"));
    for (int n = 1; n <= 250; ++n)
        history.settle(scene_named(std::to_string(n)));
    int undone = 0;
    while (const auto scene = history.undo())
        REQUIRE(scene->name == std::to_string(250 - ++undone));
    REQUIRE(undone == 200);
    for (; undone > 0; --undone)
        REQUIRE(history.redo()->name == std::to_string(250 - undone + 1));
    REQUIRE_FALSE(history.can_redo());
}

TEST_CASE("Random edits, undos and redos end as a plain list of scenes with a place in it says") {
    app::History history;
    history.restart(scene_named("0"));
    std::vector<std::string> list{"0"};
    std::size_t place = 0;
    clothlab::sim::SplitMix64 random(8);
    for (int n = 1; n < 2000; ++n) {
        switch (random.next() % 3) {
        case 0:
            list.resize(place + 1);
            list.push_back(std::to_string(n));
            history.settle(scene_named(list[++place]));
            if (list.size() > 201) {
                list.erase(list.begin());
                --place;
            }
            break;
        case 1:
            REQUIRE(history.can_undo() == (place > 0));
            if (const auto scene = history.undo())
                REQUIRE(scene->name == list[--place]);
            break;
        default:
            REQUIRE(history.can_redo() == (place + 1 < list.size()));
            if (const auto scene = history.redo())
                REQUIRE(scene->name == list[++place]);
        }
    }
}
