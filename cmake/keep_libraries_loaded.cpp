// Linked into the programs of the address sanitizer's build with the GUI. The leak report comes after the OpenGL driver
// has been unloaded, when its leaks can no longer be told by its name (cmake/lsan.supp) from ours: so nothing is unloaded.
extern "C" int dlclose(void*);
extern "C" int dlclose(void*) { return 0; }
