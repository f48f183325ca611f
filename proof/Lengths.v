(* SPDX-License-Identifier: MIT *)
(* The shoulder rotor's length. half2 is half the square of the length that the root divides out. The
   lemmas bound how near to it half2 is. *)
From Coq Require Import Reals Lra Psatz ZArith.
From Flocq Require Import Core.
From Swivel Require Import Rotors Products Wrist Rounding Near Plane.
Open Scope R_scope.

Lemma near_trans c1 c2 c x y z : 0 <= c1 -> 0 <= z -> c1 + c2 + c1 * c2 <= c -> near c1 x y -> near c2 y z ->
  near c x z.
Proof.
  intros H1 Hz Hc N1 N2. unfold near in *. pose proof (near_bounds _ _ _ N2) as B.
  assert (c1 * y <= c1 * ((1 + c2) * z)) by (apply Rmult_le_compat_l; lra).
  assert ((c1 + c2 + c1 * c2) * z <= c * z) by (apply Rmult_le_compat_r; lra).
  replace (x - z) with ((x - y) + (y - z)) by ring. eapply Rle_trans. apply Rabs_triang. lra.
Qed.
Lemma near_sym c c' x y : 0 <= c -> 0 <= y -> c <= c' * (1 - c) -> 0 <= c' -> near c x y -> near c' y x.
Proof.
  intros Hc Hy H Hc' N. pose proof (near_bounds _ _ _ N) as B. unfold near in *. rewrite Rabs_minus_sym.
  assert (c' * ((1 - c) * y) <= c' * x) by (apply Rmult_le_compat_l; lra).
    assert (c * y <= c' * (1 - c) * y) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma near_square c c' x y : 0 <= c <= 1 -> 0 <= y -> c + c + c * c <= c' -> near c x y -> near c' (x * x) (y * y).
Proof. intros. now apply near_mul with c c. Qed.
Lemma near_u x : relative x -> 0 <= x -> near 5.9605e-8 (fl32 x) x.
Proof. intros. apply near_fl with 0; try assumption; try lra. rewrite u_val; lra. apply near_refl. Qed.
Lemma near_u2 x y : relative x -> 0 <= x -> y * y = x * x -> near 1.19211e-7 (fl32 x * fl32 x) (y * y).
Proof. intros R P E. rewrite E. apply near_square with 5.9605e-8; try lra. now apply near_u. Qed.

(* lift2 against the sum of the squares of its components: p m is a b, up to four roundings *)
Section Lift.
Variables longer shorter ahead behind r : R.
Hypotheses (P1 : 0 <= longer) (P2 : 0 <= shorter) (P3 : 0 <= ahead) (P4 : 0 <= behind) (P5 : 0 < r).
Hypotheses (Ra : relative (behind * ahead)) (Rb : relative (shorter * longer)) (Rp : relative (ahead * longer))
  (Rm : relative (behind * shorter)).
Let a := fl32 (behind * ahead).
Let b := fl32 (shorter * longer).
Let p := fl32 (ahead * longer).
Let m := fl32 (behind * shorter).
Let ca := fl32 (a * r).
Let sa := fl32 (b * r).
Let ch := fl32 (sqrt ca).
Let sh := fl32 (sqrt sa).
Let top := Rmax p m.
Let low := Rmin p m.
Let larger := fl32 (top * r).
Let smaller := fl32 (ch * sh).
Let ratio := fl32 (fl32 (p + m) * r).
Hypotheses (Rca : relative (a * r)) (Rsa : relative (b * r)) (Rch : relative (sqrt ca)) (Rsh : relative (sqrt sa))
  (Rl : relative (top * r)) (Rs : relative (ch * sh)).
Hypotheses (Rr : relative (fl32 (p + m) * r)) (R2 : relative (larger * ratio)).

Lemma lift_squares : near 5.967e-7 (fl32 (larger * ratio)) (larger * larger + smaller * smaller).
Proof.
  assert (Za : 0 <= behind * ahead) by now apply Rmult_le_pos.
    assert (Zb : 0 <= shorter * longer) by now apply Rmult_le_pos.
  assert (Zp : 0 <= ahead * longer) by now apply Rmult_le_pos.
    assert (Zm : 0 <= behind * shorter) by now apply Rmult_le_pos.
  assert (Qa : 0 <= a) by now apply fl_pos. assert (Qb : 0 <= b) by now apply fl_pos.
    assert (Qp : 0 <= p) by now apply fl_pos. assert (Qm : 0 <= m) by now apply fl_pos.
  assert (Qca : 0 <= ca) by (apply fl_pos; apply Rmult_le_pos; lra).
    assert (Qsa : 0 <= sa) by (apply fl_pos; apply Rmult_le_pos; lra).
  assert (Qch : 0 <= ch) by apply fl_pos, sqrt_pos. assert (Qsh : 0 <= sh) by apply fl_pos, sqrt_pos.
  assert (Qt : 0 <= top) by (apply Rle_trans with (2 := Rmax_l _ _); assumption).
  assert (Ql : 0 <= low) by (unfold low; apply Rmin_glb; assumption).
  assert (Etl : top * low = p * m) by (unfold top, low, Rmax, Rmin; destruct (Rle_dec p m); ring).
  assert (Esum : top + low = p + m) by (unfold top, low, Rmax, Rmin; destruct (Rle_dec p m); ring).
  assert (Ltl : low <= top) by (unfold top, low, Rmax, Rmin; destruct (Rle_dec p m); lra).
  assert (Qtr : 0 <= top * r) by (apply Rmult_le_pos; lra).
  assert (Qlg : 0 <= larger) by now apply fl_pos.
  (* a b is p m *)
  assert (N1 : near 1.19211e-7 (a * b) (behind * ahead * (shorter * longer))) by (apply near_mul with 5.9605e-8
    5.9605e-8; try assumption; try lra; now apply near_u).
  assert (N2 : near 1.19211e-7 (p * m) (behind * ahead * (shorter * longer))).
  { replace (behind * ahead * (shorter * longer)) with (ahead * longer * (behind * shorter)) by ring.
    apply near_mul with 5.9605e-8 5.9605e-8; try assumption; try lra; now apply near_u. }
  assert (Z4 : 0 <= behind * ahead * (shorter * longer)) by now apply Rmult_le_pos.
  assert (Qpm : 0 <= p * m) by now apply Rmult_le_pos.
  assert (N3 : near 2.38423e-7 (a * b) (p * m)).
  { apply near_trans with 1.19211e-7 1.192111e-7 (behind * ahead * (shorter * longer)); try assumption; try lra.
    apply near_sym with 1.19211e-7; try assumption; lra. }
  (* smaller^2 *)
  assert (N4 : near 1.19211e-7 (ch * ch) ca). { rewrite <- (sqrt_sqrt ca) at 1 by assumption. apply near_u2. exact Rch.
    apply sqrt_pos. reflexivity. }
  assert (N5 : near 1.19211e-7 (sh * sh) sa). { rewrite <- (sqrt_sqrt sa) at 1 by assumption. apply near_u2. exact Rsh.
    apply sqrt_pos. reflexivity. }
  assert (Qar : 0 <= a * r) by (apply Rmult_le_pos; lra). assert (Qbr : 0 <= b * r) by (apply Rmult_le_pos; lra).
  assert (N6 : near 1.78817e-7 (ch * ch) (a * r)) by (apply near_trans with 1.19211e-7 5.9605e-8 ca; try assumption;
    try lra; now apply near_u).
  assert (N7 : near 1.78817e-7 (sh * sh) (b * r)) by (apply near_trans with 1.19211e-7 5.9605e-8 sa; try assumption;
    try lra; now apply near_u).
  assert (N8 : near 3.57635e-7 (ch * ch * (sh * sh)) (a * r * (b * r))) by (apply near_mul with 1.78817e-7 1.78817e-7;
    try assumption; lra).
  assert (Qcs : 0 <= ch * sh) by now apply Rmult_le_pos.
  assert (N9 : near 4.76847e-7 (smaller * smaller) (a * r * (b * r))).
  { apply near_trans with 1.19211e-7 3.57635e-7 (ch * ch * (sh * sh)); try lra; try assumption. now apply Rmult_le_pos.
    replace (ch * ch * (sh * sh)) with (ch * sh * (ch * sh)) by ring. apply near_u2; try assumption. reflexivity. }
  assert (Qrr : 0 <= r * r) by (apply Rmult_le_pos; lra).
  assert (N10 : near 7.15272e-7 (smaller * smaller) (p * m * (r * r))).
  { apply near_trans with 4.76847e-7 2.38424e-7 (a * r * (b * r)); try lra; try assumption. now apply Rmult_le_pos.
    replace (a * r * (b * r)) with (a * b * (r * r)) by ring.
      apply near_mul with 2.38423e-7 0; try assumption; try lra. apply near_refl. }
  assert (N11 : near 5.9605e-8 larger (top * r)) by now apply near_u.
  assert (Qlr : 0 <= low * r) by (apply Rmult_le_pos; lra).
  assert (N12 : near 5.9606e-8 (larger * (low * r)) (p * m * (r * r))).
  { replace (p * m * (r * r)) with (top * r * (low * r)) by (rewrite <- Etl; ring).
    apply near_mul with 5.9605e-8 0; try assumption; try lra. apply near_refl. }
  set (L1 := larger * (top * r)). set (L2 := larger * (low * r)) in *.
  assert (N13 : near 7.7488e-7 (smaller * smaller) L2).
  { apply near_trans with 7.15272e-7 5.96061e-8 (p * m * (r * r)); try lra; try exact N10. now apply Rmult_le_pos.
    apply near_sym with 5.9606e-8; try lra; try exact N12. now apply Rmult_le_pos. }
  assert (N14 : near 5.9606e-8 (larger * larger) L1).
  { unfold L1. apply near_mul with 0 5.9605e-8; try assumption; try lra. apply near_refl. }
  assert (L12 : 0 <= L2 <= L1) by (unfold L1, L2; split; [now apply Rmult_le_pos|apply Rmult_le_compat_l;
    [assumption|apply Rmult_le_compat_r; lra]]).
  assert (Rboth : relative (p + m)) by (apply relative_sum; apply float_fl).
  assert (N15 : near 1.78817e-7 (fl32 (larger * ratio)) (L1 + L2)).
  { assert (Qb' : 0 <= fl32 (p + m)) by (apply fl_pos; lra).
    assert (Qb'' : 0 <= fl32 (p + m) * r) by (apply Rmult_le_pos; lra). assert (Qr : 0 <= ratio) by now apply fl_pos.
    apply near_trans with 5.9605e-8 1.19211e-7 (larger * ratio); try lra. apply near_u. exact R2.
      now apply Rmult_le_pos.
    replace (L1 + L2) with (larger * ((p + m) * r)) by (unfold L1, L2; rewrite <- Esum; ring).
    apply near_mul with 0 1.1921001e-7; try assumption; try lra. apply Rmult_le_pos; lra. apply near_refl.
    apply near_trans with 5.9605e-8 5.9605e-8 (fl32 (p + m) * r); try lra. apply Rmult_le_pos; lra. now apply near_u.
    apply near_mul with 5.9605e-8 0; try lra. apply near_u. exact Rboth. lra. apply near_refl. }
  apply near_bounds in N13. apply near_bounds in N14. apply near_bounds in N15. apply near_intro.
    clear - N13 N14 N15 L12. lra.
Qed.
End Lift.

(* the square of a sum of quaternions, of which one is short *)
Lemma q2n_near c c' q q' : 0 <= c <= 1 -> c + c + c * c <= c' -> q2n (qsub q' q) <= c * c * q2n q ->
  near c' (q2n q') (q2n q).
Proof.
  intros Hc Hc' H. pose proof (q2n_pos q) as P.
  set (dot := qw q * (qw q' - qw q) + qx q * (qx q' - qx q) + qy q * (qy q' - qy q) + qz q * (qz q' - qz q)).
  assert (E : q2n q' = q2n q + 2 * dot + q2n (qsub q' q)) by (unfold dot, q2n, qsub; simpl; ring).
  set (N := q2n q) in *. set (D := q2n (qsub q' q)) in *. pose proof (q2n_pos (qsub q' q)) as PD. fold D in PD.
  assert (S1 : 0 <= c * c * N + 2 * c * dot + D).
  { replace (c * c * N + 2 * c * dot + D) with (q2n (q4 (c * qw q + (qw q' - qw q)) (c * qx q + (qx q' - qx q)) (c * qy
    q + (qy q' - qy q)) (c * qz q + (qz q' - qz q)))). apply q2n_pos.
    unfold N, D, dot, q2n, qsub; simpl; ring. }
  assert (S2 : 0 <= c * c * N - 2 * c * dot + D).
  { replace (c * c * N - 2 * c * dot + D) with (q2n (q4 (c * qw q - (qw q' - qw q)) (c * qx q - (qx q' - qx q)) (c * qy
    q - (qy q' - qy q)) (c * qz q - (qz q' - qz q)))). apply q2n_pos.
    unfold N, D, dot, q2n, qsub; simpl; ring. }
  assert (B : - (c * N) <= dot <= c * N).
  { destruct (Req_dec c 0) as [Z|Z].
    - (* then D is zero, and dot with it *)
      subst c. assert (D = 0) by lra. assert (dot = 0).
      { assert (Z4 : qw q' - qw q = 0 /\ qx q' - qx q = 0 /\ qy q' - qy q = 0 /\ qz q' - qz q = 0).
        { unfold D, q2n, qsub in H0; simpl in H0. pose proof (Rle_0_sqr (qw q' - qw q)).
          pose proof (Rle_0_sqr (qx q' - qx q)). pose proof (Rle_0_sqr (qy q' - qy q)).
          pose proof (Rle_0_sqr (qz q' - qz q)).
          unfold Rsqr in *. repeat split; apply Rsqr_0_uniq; unfold Rsqr; lra. }
        unfold dot. destruct Z4 as [Z1 [Z2 [Z3 Z4]]]. rewrite Z1, Z2, Z3, Z4. ring. }
      lra.
    - assert (Pc : 0 < c) by lra. split; apply Rmult_le_reg_l with (2 * c); lra. }
  assert (c * N + c * N + c * c * N <= c' * N) by (replace (c * N + c * N + c * c * N) with ((c + c + c * c) * N) by
    ring; apply Rmult_le_compat_r; lra).
  assert (0 <= c * N) by (apply Rmult_le_pos; lra). assert (0 <= c * c * N) by (apply Rmult_le_pos;
    [apply Rmult_le_pos|]; lra).
  apply near_intro. lra.
Qed.

(* the middle line: its squared length is 2 length height, whatever the rounding of the length *)
Lemma middle_near_squares l H rho2 length height : 0 < l -> l <= H <= 2 * l -> rho2 + H * H = 2 * l * H ->
  near 1.5e-7 length l -> near 2.2e-7 height H ->
  near 3.71e-7 (rho2 + height * height) (2 * (length * height)).
Proof.
  intros Pl HH E Nl Nh.
  set (d := length / l - 1). set (e := height / H - 1).
  assert (Ed : length = l * (1 + d)) by (unfold d; field; lra).
    assert (Ee : height = H * (1 + e)) by (unfold e; field; lra).
  assert (Bd : - 1.5e-7 <= d <= 1.5e-7). { apply near_bounds in Nl. rewrite Ed in Nl.
    split; apply Rmult_le_reg_l with l; lra. }
  assert (Be : - 2.2e-7 <= e <= 2.2e-7). { apply near_bounds in Nh. rewrite Ee in Nh.
    split; apply Rmult_le_reg_l with H; lra. }
  set (t := H / l). assert (Et : H = t * l) by (unfold t; field; lra).
  assert (Bt : 1 <= t <= 2) by (split; apply Rmult_le_reg_r with l; lra).
  (* all is a multiple of l H *)
  set (Y := l * H). assert (PY : 0 < Y) by (apply Rmult_lt_0_compat; lra).
  assert (E1 : rho2 + height * height = Y * (2 + t * (2 * e + e * e))).
  { replace rho2 with (2 * l * H - H * H) by lra. rewrite Ee. unfold Y. rewrite Et. ring. }
  assert (E2 : 2 * (length * height) = Y * (2 * ((1 + d) * (1 + e)))) by (rewrite Ed, Ee; unfold Y; ring).
  assert (De : -1e-13 <= d * e <= 1e-13) by (split; nra). assert (ee : 0 <= e * e <= 1e-13) by (split; nra).
  assert (te : - 2.2e-7 <= (t - 1) * e <= 2.2e-7).
  { split. apply Rle_trans with ((t - 1) * - 2.2e-7). lra. apply Rmult_le_compat_l; lra.
    apply Rle_trans with ((t - 1) * 2.2e-7). apply Rmult_le_compat_l; lra. lra. }
  assert (tee : 0 <= t * (e * e) <= 2e-13) by (split; [apply Rmult_le_pos; lra|apply Rle_trans with (2 * 1e-13);
    [apply Rmult_le_compat; lra|lra]]).
  unfold near. rewrite E1, E2. replace (Y * (2 + t * (2 * e + e * e)) - Y * (2 * ((1 + d) * (1 + e)))) with (Y * (2 *
    ((t - 1) * e) + t * (e * e) - 2 * d - 2 * (d * e))) by ring.
  rewrite Rabs_mult, (Rabs_right Y) by lra.
  replace (3.71e-7 * (Y * (2 * ((1 + d) * (1 + e))))) with (Y * (3.71e-7 * (2 * (1 + d + e + d * e)))) by ring.
  apply Rmult_le_compat_l. lra. apply Rabs_le. lra.
Qed.

(* the rotor: mt the exact product of middle line and twist, g the rounded one; lift2 and half2 as computed *)
Section Rotor.
Variables X T N height_length middle twist2 lift2 half half2 root scale : R.
Variables g2 q : Q4.
Hypotheses (PX : 0 < X) (PT : 0 < T) (PN : 0 < N) (PY : 0 < height_length).
Hypothesis HX : near 3.71e-7 X (2 * height_length).
Hypothesis Hm : near 6e-8 middle height_length.
Hypothesis Ht : near 1.193e-7 twist2 T.
Hypothesis Hl : near 5.967e-7 lift2 N.
Hypotheses (Rh : relative (middle * twist2)) (Eh : half = fl32 (middle * twist2)) (R2 : relative (half * lift2))
  (E2 : half2 = fl32 (half * lift2)).
Hypotheses (Rr : relative (sqrt half2)) (Er : root = fl32 (sqrt half2)) (Rs : relative (11863283 / 16777216 / root))
  (Es : scale = fl32 (11863283 / 16777216 / root)).
Hypothesis Hg2 : near 5.0821e-7 (q2n g2) (X * T * N).
Hypothesis Hq : q2n (qsub q (qscale scale g2)) <= (1.001*u)*(1.001*u) * q2n (qscale scale g2).

Lemma half2_near : near 8.955e-7 half2 (height_length * T * N).
Proof.
  assert (P1 : 0 <= height_length * T) by (apply Rmult_le_pos; lra).
  assert (N1 : near 1.794e-7 (middle * twist2) (height_length * T)) by (apply near_mul with 6e-8 1.193e-7; try lra;
    assumption).
  assert (N2 : near 2.391e-7 half (height_length * T)). { rewrite Eh.
    apply near_fl with 1.794e-7; try lra; try assumption. rewrite u_val; lra. }
  assert (N3 : near 8.35801e-7 (half * lift2) (height_length * T * N)) by (apply near_mul with 2.391e-7 5.967e-7;
    try lra; assumption).
  rewrite E2. apply near_fl with 8.35801e-7; try lra; try assumption. apply Rmult_le_pos; lra. rewrite u_val; lra.
Qed.
Lemma scale_pos : 0 < root /\ 0 < scale /\ near 1.19211e-7 (root * root) half2 /\ 0 < half2.
Proof.
  pose proof half2_near as N1. pose proof (near_bounds _ _ _ N1) as B1.
  assert (P : 0 < height_length * T * N) by (apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat|]; assumption).
  assert (Ph : 0 < half2) by lra. pose proof (sqrt_lt_R0 _ Ph) as Ps.
  pose proof (near_bounds _ _ _ (near_u _ Rr ltac:(lra))) as B2. rewrite <- Er in B2. assert (Pr : 0 < root) by lra.
  assert (Pq : 0 < 11863283 / 16777216 / root) by (apply Rdiv_lt_0_compat; lra).
  pose proof (near_bounds _ _ _ (near_u _ Rs ltac:(lra))) as B3. rewrite <- Es in B3.
  repeat split; try lra. rewrite Er. rewrite <- (sqrt_sqrt half2) at 3 by lra. apply near_u2. exact Rr. lra.
    reflexivity.
Qed.
Lemma norm_before : near 2.048e-6 (q2n (qscale scale g2)) 1.
Proof.
  destruct scale_pos as [Pr [Ps [N1 Ph]]]. pose proof half2_near as N2.
  set (Z := height_length * T * N) in *. assert (PZ : 0 < Z) by (unfold Z; apply Rmult_lt_0_compat;
    [apply Rmult_lt_0_compat|]; assumption).
  (* g2 is twice Z *)
  assert (N3 : near 8.7922e-7 (q2n g2) (2 * Z)).
  { apply near_trans with 5.0821e-7 3.71e-7 (X * T * N); try lra; try assumption.
    unfold Z. replace (2 * (height_length * T * N)) with (2 * height_length * (T * N)) by ring. rewrite Rmult_assoc.
    apply near_mul with 3.71e-7 0; try lra; try assumption. apply Rmult_le_pos; lra. apply near_refl. }
  assert (N4 : near 1.01472e-6 (root * root) Z) by (apply near_trans with 1.19211e-7 8.955e-7 half2; try lra;
    assumption).
  assert (N5 : near 1.01473e-6 Z (root * root)) by (apply near_sym with 1.01472e-6; try lra; assumption).
  (* the scale times the root is the root of one half *)
  set (k2 := 11863283 / 16777216) in *. assert (Pk : 0 < k2) by (unfold k2; lra).
  assert (Prr : 0 < root * root) by (now apply Rmult_lt_0_compat).
  assert (Pq : 0 < k2 / root) by (now apply Rdiv_lt_0_compat).
  assert (N6 : near 1.19211e-7 (scale * scale) (k2 / root * (k2 / root))) by (rewrite Es; apply near_u2;
    [exact Rs|lra|reflexivity]).
  assert (Pkk : 0 < k2 / root * (k2 / root)) by (now apply Rmult_lt_0_compat).
  assert (N7 : near 1.89397e-6 (q2n g2) (2 * (root * root))).
  { apply near_trans with 8.7922e-7 1.01474e-6 (2 * Z); try lra; try assumption.
    apply near_mul with 0 1.01473e-6; try lra; try assumption. apply near_refl. }
  assert (N8 : near 2.0133e-6 (scale * scale * q2n g2) (k2 / root * (k2 / root) * (2 * (root * root)))) by (apply
    near_mul with 1.19211e-7 1.89397e-6; try lra; assumption).
  replace (k2 / root * (k2 / root) * (2 * (root * root))) with (2 * k2 * k2) in N8 by (field; lra).
  replace (q2n (qscale scale g2)) with (scale * scale * q2n g2) by (unfold q2n, qscale; simpl; ring).
  apply near_bounds in N8. apply near_intro. unfold k2 in N8. lra.
Qed.
Lemma norm : near 2.17e-6 (q2n q) 1.
Proof.
  pose proof norm_before as N1.
  assert (N2 : near 1.1936e-7 (q2n q) (q2n (qscale scale g2))) by (apply q2n_near with (1.001 * u); try exact Hq;
    rewrite u_val; lra).
  apply near_trans with 1.1936e-7 2.048e-6 (q2n (qscale scale g2)); try lra; assumption.
Qed.
Lemma unit_length : Rabs (qnorm q - 1) <= 1.1e-6.
Proof.
  pose proof (near_bounds _ _ _ norm) as B. unfold qnorm. apply Rabs_le. split.
  - assert (1 - 1.1e-6 <= sqrt (q2n q)). { rewrite <- (sqrt_square (1 - 1.1e-6)) by lra. apply sqrt_le_1_alt. lra.
    } lra.
  - assert (sqrt (q2n q) <= 1 + 1.1e-6). { rewrite <- (sqrt_square (1 + 1.1e-6)) by lra. apply sqrt_le_1_alt. lra.
    } lra.
Qed.
End Rotor.
