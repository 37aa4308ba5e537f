// VTK: vtkOBBTree::TriangleIntersectsNode, the node being the box.
#include "peers.h"
#include <cstdio>
#include <vtkNew.h>
#include <vtkOBBTree.h>
#include <vtkVersion.h>
static vtkNew<vtkOBBTree> tree;
static void peer_begin() {}
static const char *peer_name() { return "VTK " VTK_VERSION ", vtkOBBTree::TriangleIntersectsNode"; }
static int peer(const double v[9], const double lo[3], const double hi[3])
{
    vtkOBBNode node;
    double p[9];
    for (int i = 0; i < 9; i++) {
        p[i] = v[i];
    }
    for (int i = 0; i < 3; i++) {
        node.Corner[i] = lo[i];
        for (int k = 0; k < 3; k++) {
            node.Axes[k][i] = i == k ? hi[i] - lo[i] : 0;
        }
    }
    return tree->TriangleIntersectsNode(&node, p, p + 3, p + 6, nullptr);
}
PEER_MAIN
