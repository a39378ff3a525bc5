/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Cholesky's factors L L^T of a small matrix; see least.h.
 */
#include "least.h"

#include <math.h>

void kr_least_add(struct kr_least *fit, const double *power, double value) {
    for (int i = 0; i < fit->terms; i++) {
        fit->right[i] += power[i] * value;
        for (int j = 0; j < fit->terms; j++)
            fit->matrix[i][j] += power[i] * power[j];
    }
    fit->square += value * value;
    fit->count++;
}

/** The factor, in the lower triangle; 0: the matrix is singular. */
static int factor(const struct kr_least *fit, double lower[KR_LEAST_MOST][KR_LEAST_MOST]) {
    for (int i = 0; i < fit->terms; i++)
        for (int j = 0; j <= i; j++) {
            double sum = fit->matrix[i][j];
            for (int k = 0; k < j; k++)
                sum -= lower[i][k] * lower[j][k];
            if (i == j && !(sum > 1e-9 * fit->matrix[i][i]))
                return 0;
            lower[i][j] = i == j ? sqrt(sum) : sum / lower[j][j];
        }
    return 1;
}

static void substitute(int terms, double lower[KR_LEAST_MOST][KR_LEAST_MOST], double *x) {
    for (int i = 0; i < terms; i++) {
        for (int k = 0; k < i; k++)
            x[i] -= lower[i][k] * x[k];
        x[i] /= lower[i][i];
    }
    for (int i = terms - 1; i >= 0; i--) {
        for (int k = i + 1; k < terms; k++)
            x[i] -= lower[k][i] * x[k];
        x[i] /= lower[i][i];
    }
}

int kr_least_solve(const struct kr_least *fit, double *x,
                   double inverse[KR_LEAST_MOST][KR_LEAST_MOST], double *residual) {
    double lower[KR_LEAST_MOST][KR_LEAST_MOST];
    if (fit->count < fit->terms + 2 || !factor(fit, lower))
        return 0;
    *residual = fit->square;
    for (int i = 0; i < fit->terms; i++) {
        x[i] = fit->right[i];
        for (int j = 0; j < fit->terms; j++)
            inverse[i][j] = i == j; /* symmetric: rows are columns */
        substitute(fit->terms, lower, inverse[i]);
    }
    substitute(fit->terms, lower, x);
    for (int i = 0; i < fit->terms; i++)
        *residual -= x[i] * fit->right[i];
    *residual = fmax(*residual, 0);
    return 1;
}
