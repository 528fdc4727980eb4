// The header in C++: its names are those of C.
#include <splashdown.h>

int main() {
    splashdown_scene *scene = nullptr;
    splashdown_scene_sizes sizes{};
    if (splashdown_open("wedge", nullptr, 0, SPLASHDOWN_NODES, &scene) != SPLASHDOWN_OK) return 1;
    if (splashdown_sizes(scene, &sizes) != SPLASHDOWN_OK || sizes.nodes == 0) return 2;
    return splashdown_free_scene(scene) == SPLASHDOWN_OK ? 0 : 3;
}
