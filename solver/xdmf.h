/* SPDX-License-Identifier: BSD-3-Clause
 *
 * XDMF: the text beside run.h5 that lets ParaView open it.
 */
#ifndef KR_XDMF_H
#define KR_XDMF_H

#include "nodes.h"

/** An output that stands in the results file. */
struct kr_xdmf_step {
    long step;
    double time; /* s */
};

/** The fields of each output. */
struct kr_xdmf_fields {
    size_t n;
    const int *field; /* (n) enum kr_quantity */
    int wide;         /* they stand in float64 */
};

/** Write the sidecar of run.h5 and run/KKKKKK.h5; appears whole or not at all.
 *
 *  in  path       of the sidecar
 *  in  corners    length of /mesh/topology
 *  Stops (exit 3) where it cannot be written.
 */
void kr_xdmf_write(const char *path, const struct kr_nodes *nodes, size_t corners,
                   struct kr_xdmf_fields fields, size_t n_steps, const struct kr_xdmf_step *step);

#endif
