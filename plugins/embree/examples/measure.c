/* Measures the phases of a scene's tree, and proves that each of them is in one piece.
 *
 *   measure SCENE.json
 */
#include <phasetree/phasetree_embree.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program with the library's message if a call has failed. */
static void check(PhasetreeError error) {
    if (error == PHASETREE_ERROR_NONE) return;
    fprintf(stderr, "%s\n", phasetreeGetErrorMessage());
    exit(1);
}

int main(int argc, char** argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: %s SCENE.json\n", argv[0]);
        return 2;
    }
    PhasetreeTree tree;
    unsigned int count;
    check(phasetreeNewTreeFromFile(PHASETREE_API_VERSION, argv[1], NULL, &tree));
    check(phasetreeGetTreePhaseCount(tree, &count));

    /* Static, because 64 phases are too large for some stacks. */
    static PhasetreeMeasuredPhase phases[PHASETREE_MAX_PHASES];
    static PhasetreeStatement statements[PHASETREE_MAX_PHASES];
    static PhasetreeProof proofs[PHASETREE_MAX_PHASES];
    PhasetreeMeasureOptions measuring;
    phasetreeInitMeasureOptions(&measuring);
    measuring.tolerance = 0.01;
    measuring.seconds = 10;
    check(phasetreeMeasureTree(tree, &measuring, phases, NULL, NULL));

    PhasetreeProveOptions proving;
    phasetreeInitProveOptions(&proving);
    proving.seconds = 10;
    for (unsigned int i = 1; i < count; ++i)
        phasetreeInitStatement(&statements[i - 1], PHASETREE_STATEMENT_CONNECTED, (PhasetreePhaseSet)1 << i);
    check(phasetreeProveStatements(tree, statements, count - 1, &proving, proofs, NULL, 0, NULL));

    static const char* const verdicts[] = {"proved", "refuted", "undecided"};
    for (unsigned int i = 1; i < count; ++i) {
        const char* name;
        const PhasetreeProof* proof = &proofs[i - 1];
        check(phasetreeGetTreePhaseName(tree, i, &name));
        printf("%s: volume %g to %g; in one piece: %s%s%s\n", name, phases[i].body.volume.low,
               phases[i].body.volume.high, verdicts[proof->verdict], proof->reason[0] ? ", " : "", proof->reason);
    }
    check(phasetreeReleaseTree(tree));
    return 0;
}
