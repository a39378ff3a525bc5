/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Least squares of a few terms: sum (value - sum_k x_k power_k)^2 -> min, by Cholesky's factors of
 * the normal equations. The powers should be of order 1.
 */
#ifndef KR_LEAST_H
#define KR_LEAST_H

enum { KR_LEAST_MOST = 6 }; /* terms */

struct kr_least {
    int terms;
    int count; /* values added */
    double matrix[KR_LEAST_MOST][KR_LEAST_MOST], right[KR_LEAST_MOST], square;
};

/** Add a value; begin with a struct of zeros but for `terms`. */
void kr_least_add(struct kr_least *fit, const double *power, double value);

/** Solve. Returns 0 where the values do not determine the terms, or leave no residual.
 *
 *  out  x         (terms)
 *  out  inverse   of the matrix: times the variance of a value, the covariance of x
 *  out  residual  sum of the squares that are left
 */
int kr_least_solve(const struct kr_least *fit, double *x,
                   double inverse[KR_LEAST_MOST][KR_LEAST_MOST], double *residual);

#endif
