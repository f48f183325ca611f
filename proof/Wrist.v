(* SPDX-License-Identifier: MIT *)
(* The assembly: the wrist's error from the errors of its parts. u = 2^-24 is the largest relative error of a rounding
   to 24 bits. *)
From Coq Require Import Reals Lra Psatz.
From Swivel Require Import Rotors Products Elbow Straight.
Open Scope R_scope.

Definition u := / 16777216.
Definition k := u * (1 + u).
Lemma u_val : u = 5.9604644775390625e-8. Proof. unfold u. lra. Qed.

(* a quaternion that is c off turns vectors by 2 c at most *)
Lemma near_c c q' q v : 0 <= c < 1 -> 0 < q2n q -> q2n (qsub q' q) <= c * c * q2n q ->
  0 < q2n q' /\ vnorm (vsub (rot q' v) (rot q v)) <= 2 * c * vnorm v.
Proof.
  intros Hc Hq Hd.
  assert (P : 0 < q2n q').
  { destruct (Rle_lt_or_eq_dec 0 (q2n q') (q2n_pos q')) as [L|E]; [exact L|exfalso].
    assert (Z : qw q' = 0 /\ qx q' = 0 /\ qy q' = 0 /\ qz q' = 0).
    { unfold q2n in E. repeat split; nra. }
    destruct Z as [Z1 [Z2 [Z3 Z4]]].
    assert (E2 : q2n (qsub q' q) = q2n q) by (unfold q2n, qsub; simpl; rewrite Z1, Z2, Z3, Z4; ring).
    rewrite E2 in Hd. assert (c * c < 1) by nra. nra. }
  split; [exact P|].
  apply Rle_trans with (1 := rot_near q' q v Hq P).
  apply Rmult_le_compat_r. apply sqrt_pos.
  apply Rmult_le_compat_l. lra.
  unfold qnorm. rewrite <- sqrt_div_alt by assumption.
  rewrite <- (sqrt_square c) by lra. apply sqrt_le_1_alt.
  apply Rmult_le_reg_r with (q2n q); [assumption|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.

(* one squared length and its root *)
Lemma sqrt_lin x e : 0 <= x -> -1/2 <= e -> sqrt (x * x * (1 + e)) <= x * (1 + e/2).
Proof. intros. rewrite <- (sqrt_square (x * (1 + e/2))) by (apply Rmult_le_pos; lra). apply sqrt_le_1_alt.
  replace (x*(1+e/2)*(x*(1+e/2))) with (x*x*((1+e/2)*(1+e/2))) by ring. apply Rmult_le_compat_l; nra. Qed.
Lemma sqrt_low x e : 0 <= x -> 0 <= e <= 1/1000 -> x * (1 - 0.501 * e) <= sqrt (x * x * (1 - e)).
Proof. intros. rewrite <- (sqrt_square (x * (1 - 0.501*e))) by (apply Rmult_le_pos; lra). apply sqrt_le_1_alt.
  replace (x*(1-0.501*e)*(x*(1-0.501*e))) with (x*x*((1-0.501*e)*(1-0.501*e))) by ring. apply Rmult_le_compat_l; nra.
    Qed.
Lemma bent_norm c s L1 L2 : 0 < L1 -> 0 < L2 -> c <> 0 \/ s <> 0 -> vnorm (bent c s L1 L2) <= L1 + L2.
Proof.
  intros. unfold bent. eapply Rle_trans. apply vtri. apply Rplus_le_compat.
  - unfold vnorm, v2n; simpl. replace (0*0+0*0+L1*L1) with (L1*L1) by ring. rewrite sqrt_square; lra.
  - rewrite rot_norm. unfold vnorm, v2n; simpl. replace (0*0+0*0+L2*L2) with (L2*L2) by ring. rewrite sqrt_square; lra.
    unfold q2n; simpl. destruct H1; nra.
Qed.

Definition ok e := Rabs e <= u.
Definition two A B a b c := (A * (1 + a) + B * (1 + b)) * (1 + c).   (* two rounded products, their rounded sum *)
Lemma two_err A B a b c : ok a -> ok b -> ok c -> Rabs (two A B a b c - (A + B)) <= k * (Rabs A + Rabs B + Rabs (A +
  B)).
Proof. intros. unfold two, k. apply round_pair; try assumption. rewrite u_val; lra. Qed.
Lemma one_err A a : ok a -> Rabs (A * (1 + a) - A) <= k * Rabs A.
Proof. intro H. unfold ok in H. replace (A * (1+a) - A) with (A * a) by ring. rewrite Rabs_mult.
  pose proof (Rabs_pos A).
  apply Rle_trans with (Rabs A * u). apply Rmult_le_compat_l; assumption. unfold k. rewrite u_val. rewrite Rmult_comm.
    apply Rmult_le_compat_r; lra. Qed.
Lemma ok_low e : ok e -> 1 - u <= 1 + e <= 1 + u.
Proof. unfold ok. intro H. unfold Rabs in H; destruct (Rcase_abs e); lra. Qed.
Lemma c_ok c : 0 <= c <= 3 -> 0 <= c * k < 1.
Proof. intros. unfold k. rewrite u_val. split; [apply Rmult_le_pos|]; nra. Qed.
Lemma rot_twist t0 t3 z : 0 < t0*t0 + t3*t3 -> rot (q4 t0 0 0 t3) (v3 0 0 z) = v3 0 0 z.
Proof. intro H. unfold rot, sand, vscale, q2n; simpl. f_equal; field; nra. Qed.

Lemma clamp_err' l' lh' S N F' An : 0 < l' -> 0 <= N <= S -> Rabs (lh' - l') <= 2.511 * u * l' ->
  Rabs (F' - S) <= u * S -> Rabs (An - N) <= u * S -> An <= F' ->
  Rabs (Rmin (Rmax lh' An) F' - Rmin (Rmax l' N) S) <= 2.53 * u * S.
Proof.
  intros Q1 HN H1 H2 H3 HA. unfold u in *.
  assert (B : forall a b, Rabs a <= b -> -b <= a <= b) by (intros a b H; unfold Rabs in H; destruct (Rcase_abs a); lra).
  apply B in H1. apply B in H2. apply B in H3. apply Rabs_le. clear -Q1 HN H1 H2 H3 HA.
  unfold Rmin, Rmax. destruct (Rle_dec lh' An), (Rle_dec l' N); repeat destruct (Rle_dec _ _); lra.
Qed.

Section Arm.
Variables w1 w2 w3 L1 L2 t0 t3 r kap sg : R.
Variables lh d7 d8 d9 : R.
Variables g g2 q : Q4.
Variables e1 e2 e3 e4 e5 e6 e7 e8 e9 e10 e11 e12 e13 e14 : R.
Hypotheses (K7 : ok d7) (K8 : ok d8) (K9 : ok d9).
Hypotheses (E1 : ok e1) (E2 : ok e2) (E3 : ok e3) (E4 : ok e4) (E5 : ok e5) (E6 : ok e6) (E7 : ok e7) (E8 : ok e8)
  (E9 : ok e9) (E10 : ok e10) (E11 : ok e11) (E12 : ok e12) (E13 : ok e13) (E14 : ok e14).
Hypotheses (HL1 : 0 < L1) (HL2 : 0 < L2) (Hr : 0 < r) (Hkap : 0 < kap) (Ht : 0 < t0*t0 + t3*t3)
  (Hsg : sg = 1 \/ sg = -1) (Hw3 : 0 <= sg * w3).

(* swivel_plane, frame_start *)
Let l := sqrt (w1*w1 + w2*w2 + w3*w3).
Hypothesis lh_err : Rabs (lh - l) <= 2.511 * u * l.
Let h := (lh + sg * w3) * (1+d7).
(* bend_elbow *)
Let F := (L1 + L2) * (1+d8).
Let D := (L1 - L2) * (1+d9).
Let d := Rmin (Rmax lh (Rabs D)) F.
Let P := p F D d e2 e4 e7.
Let M := m F D d e1 e3 e8.
Let CH := ch D d e1 e2 e5 e9 e11 r.
Let SH := sh F d e3 e4 e6 e10 e12 r.
Let SM := smaller F D d e1 e2 e3 e4 e5 e6 e9 e10 e11 e12 e13 r.
Variables lc ls : R.
Hypothesis Hl : (M <= P /\ lc = larger e14 r P /\ ls = SM) \/ (P <= M /\ lc = SM /\ ls = larger e14 r M).
Hypothesis Hl0 : 0 < l.        (* follows from `holds` *)
Hypothesis HDF : Rabs D < F.   (* follows from `holds` *)
(* turn_shoulder: central_line(middle) * twist, then * lift, then the root's scale; t0 + t3 k is the twist *)
Let Lq := lift_q sg lc ls.
Let mt0 := qmul (q4 0 w1 w2 (sg*h)) (q4 t0 0 0 t3).
Hypothesis G1 : q2n (qsub g mt0) <= (1.8482*k)*(1.8482*k) * q2n mt0.
Hypothesis G2 : q2n (qsub g2 (qmul g Lq)) <= (2.4147*k)*(2.4147*k) * q2n (qmul g Lq).
Hypothesis G3 : q2n (qsub q (qscale kap g2)) <= (1.001*u)*(1.001*u) * q2n (qscale kap g2).

Let S := L1 + L2.
Let ds := Rmin (Rmax l (Rabs (L1 - L2))) S.   (* the reachable distance nearest to the target's *)

Lemma El : l * l = w1*w1 + w2*w2 + w3*w3.
Proof. unfold l. apply sqrt_sqrt. nra. Qed.
Lemma F_err : Rabs (F - S) <= u * S.
Proof. unfold F, S. replace ((L1+L2)*(1+d8) - (L1+L2)) with ((L1+L2)*d8) by ring.
  rewrite Rabs_mult, (Rabs_right (L1+L2)) by lra. unfold ok in K8. rewrite Rmult_comm. apply Rmult_le_compat_r; lra.
  Qed.
Lemma diff_le : Rabs (L1 - L2) <= S.
Proof. unfold S. unfold Rabs; destruct (Rcase_abs _); lra. Qed.
Lemma D_err : Rabs (D - (L1 - L2)) <= u * S.
Proof. unfold D. replace ((L1-L2)*(1+d9) - (L1-L2)) with ((L1-L2)*d9) by ring. rewrite Rabs_mult. unfold ok in K9.
  pose proof diff_le. pose proof (Rabs_pos d9). pose proof (Rabs_pos (L1-L2)).
  rewrite Rmult_comm. apply Rmult_le_compat; lra. Qed.
Lemma bones_err : Rabs (L1 - (F+D)/2) + Rabs (L2 - (F-D)/2) <= u * S.
Proof.
  pose proof F_err as X. pose proof D_err as Y. unfold S in *.
  assert (B : forall a b, Rabs a <= b -> -b <= a <= b) by (intros a b H; unfold Rabs in H; destruct (Rcase_abs a); lra).
  apply B in X. apply B in Y. unfold Rabs; repeat destruct (Rcase_abs _); lra.
Qed.
Lemma d_err : Rabs (d - ds) <= 2.53 * u * S.
Proof.
  unfold d, ds. apply clamp_err'; try assumption. split. apply Rabs_pos. apply diff_le. apply F_err.
  apply Rle_trans with (2 := D_err). apply Rabs_triang_inv2. lra.
Qed.
Lemma lh_pos : 0 < lh.
Proof. pose proof lh_err as X. rewrite u_val in X. unfold Rabs in X; destruct (Rcase_abs (lh - l)); lra. Qed.
Lemma d_range : 0 < d /\ Rabs D <= d /\ d <= F.
Proof.
  pose proof lh_pos. pose proof (Rabs_pos D). unfold d, Rmin, Rmax. repeat destruct (Rle_dec _ _); lra.
Qed.
Lemma eps_err : exists eps, h = (l + sg*w3)*(1+eps) /\ Rabs eps <= 3.52 * u.
Proof.
  set (H := l + sg*w3). assert (HH : 0 < H) by (unfold H; lra).
  exists (h/H - 1). split. field; lra.
  assert (X : Rabs (h - H) <= 3.52 * u * H).
  { replace (h - H) with ((lh - l)*(1+d7) + H*d7) by (unfold h, H; ring). eapply Rle_trans. apply Rabs_triang.
    rewrite !Rabs_mult, (Rabs_right H) by lra.
    pose proof (ok_low _ K7) as O. unfold ok in K7. rewrite (Rabs_right (1+d7)) by (rewrite u_val in O; lra).
    pose proof lh_err as Y. pose proof (Rabs_pos (lh - l)).
    assert (Rabs (lh - l) * (1+d7) <= 2.511*u*l*(1+u)). { pose proof u_val. apply Rmult_le_compat; lra. }
    assert (H * Rabs d7 <= H * u) by (apply Rmult_le_compat_l; lra).
    assert (l <= H) by (unfold H; lra). rewrite u_val in *. lra. }
  replace (h/H - 1) with ((h - H)/H) by (field; lra). unfold Rdiv.
    rewrite Rabs_mult, (Rabs_right (/H)) by (left; now apply Rinv_0_lt_compat).
  apply Rmult_le_reg_r with H; [assumption|]. rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.

Theorem wrist_core :
  vnorm (vsub (wrist_fk q CH SH L1 L2) (vscale (ds / l) (v3 w1 w2 w3))) <= 1.59e-6 * (L1 + L2).
Proof.
  destruct d_range as [Pd [RD RF]].
  assert (Hu : 0 <= u < 1/2) by (rewrite u_val; lra).
  destruct (elbow u F D d e1 e2 e3 e4 e5 e6 e7 e8 e9 e10 e11 e12 e13 e14 r Hu E1 E2 E3 E4 E5 E6 E7 E8 E9 E10 E11 E12
    E13 E14 Hr L1 L2 sg Pd RD RF HDF Hsg lc ls Hl)
    as [NC [NL EB]].
  fold CH SH in NC, EB. fold Lq in EB.
  destruct eps_err as [eps [Eh Heps]].
  set (mid := q4 0 w1 w2 (sg*h)). set (tw := q4 t0 0 0 t3). set (mt := qmul mid tw).
  assert (sg2 : sg*sg = 1) by (destruct Hsg as [->| ->]; ring).
  assert (eb : - (3.52*u) <= eps <= 3.52*u) by (unfold Rabs in Heps; destruct (Rcase_abs eps); lra).
  assert (PH : 0 < l + sg*w3) by lra.
  assert (Ph : 0 < h) by (rewrite Eh; apply Rmult_lt_0_compat; [exact PH | pose proof u_val; lra]).
  assert (Qtw : q2n tw = t0*t0 + t3*t3) by (unfold tw, q2n; simpl; ring).
  assert (Qmid : q2n mid = w1*w1 + w2*w2 + h*h). { unfold mid, q2n; simpl.
    replace (sg*h*(sg*h)) with (sg*sg*(h*h)) by ring. rewrite sg2. ring. }
  assert (Pmid : 0 < q2n mid). { rewrite Qmid. assert (0 < h*h) by (apply Rmult_lt_0_compat; assumption).
    assert (0 <= w1*w1) by (apply Rle_0_sqr). assert (0 <= w2*w2) by (apply Rle_0_sqr). lra. }
  assert (Ptw : 0 < q2n tw) by (rewrite Qtw; assumption).
  assert (Pmt : 0 < q2n mt) by (unfold mt; rewrite q2n_mul; apply Rmult_lt_0_compat; assumption).
  assert (Pk : 0 <= k) by (unfold k; rewrite u_val; lra).
  (* the height is not below the distance of the line from e3's axis *)
  assert (Hh : w1*w1 + w2*w2 <= 1.00001 * (sg*h*(sg*h))).
  { replace (sg*h*(sg*h)) with (sg*sg*(h*h)) by ring. rewrite sg2.
    assert (l*(1 - 3.52*u) <= h). { rewrite Eh. pose proof u_val. apply Rmult_le_compat; lra. }
    assert (Hl2 : l*(1 - 3.52*u)*(l*(1-3.52*u)) <= h*h). { pose proof u_val.
      assert (0 <= l*(1-3.52*u)) by (apply Rmult_le_pos; lra). apply Rmult_le_compat; assumption. }
    pose proof El as L. assert (0 <= w3*w3) by apply Rle_0_sqr.
      assert (0 < l*l) by (apply Rmult_lt_0_compat; assumption).
    replace (l*(1-3.52*u)*(l*(1-3.52*u))) with (l*l*((1-3.52*u)*(1-3.52*u))) in Hl2 by ring.
    assert (l*l*0.999999 <= l*l*((1-3.52*u)*(1-3.52*u))). { apply Rmult_le_compat_l. lra. rewrite u_val. lra. } lra. }
  assert (Pq : q2n Lq = lc*lc + ls*ls) by apply lift_q2n.
  assert (PL : 0 < q2n Lq). { rewrite Pq. assert (0 <= lc*lc) by apply Rle_0_sqr.
    assert (0 <= ls*ls) by apply Rle_0_sqr. destruct NL as [N|N]; [assert (0 < lc*lc) by (apply Rsqr_pos_lt;
    assumption)|assert (0 < ls*ls) by (apply Rsqr_pos_lt; assumption)]; lra. }
  assert (Lform : Lq = q4 (qw Lq) (qx Lq) 0 0) by (unfold Lq, lift_q; destruct (Rlt_dec sg 0); reflexivity).
  assert (QL2 : q2n Lq = qw Lq * qw Lq + qx Lq * qx Lq) by (rewrite Lform at 1; unfold q2n; simpl; ring).
  set (vh := bent CH SH L1 L2) in *. set (x := rot Lq vh).
  assert (Nvh : vnorm vh <= S) by (unfold S, vh; apply bent_norm; assumption).
  assert (Nx : vnorm x <= S) by (unfold x; rewrite rot_norm; assumption).
  destruct (near_c (1.8482*k) g mt x (c_ok 1.8482 ltac:(lra)) Pmt G1) as [Pg N1].
  (* second product *)
  set (gl := qmul g Lq).
  assert (Pgl : 0 < q2n gl) by (unfold gl; rewrite q2n_mul; apply Rmult_lt_0_compat; assumption).
  destruct (near_c (2.4147*k) g2 gl vh (c_ok 2.4147 ltac:(lra)) Pgl G2) as [Pg2 N2].
  (* the scale *)
  set (kg := qscale kap g2).
  assert (Qkg : q2n kg = kap*kap*q2n g2) by (unfold kg, q2n, qscale; simpl; ring).
  assert (Pkg : 0 < q2n kg) by (rewrite Qkg; apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat; assumption|assumption]).
  assert (Hc3 : 0 <= 1.001*u < 1) by lra.
  destruct (near_c (1.001*u) q kg vh Hc3 Pkg G3) as [Pqq N3].
  unfold kg in N3. rewrite rot_qscale in N3 by (try assumption; lra).
  (* put together *)
  assert (R1 : rot gl vh = rot g x) by (unfold gl, x; apply rot_mul; assumption).
  assert (R2 : vnorm (vsub (rot mt x) (rot mt (v3 0 0 (sg*d)))) <= 9*(u/(1-u))*F + u*S).
  { rewrite <- rot_sub, rot_norm by assumption. unfold x. pose proof bones_err. lra. }
  assert (R3 : rot mt (v3 0 0 (sg*d)) = vscale d (rot mid (vscale sg unit3))).
  { unfold mt. rewrite rot_mul by assumption. unfold tw. rewrite rot_twist by assumption. rewrite <- rot_scale.
    f_equal. unfold vscale, unit3; simpl. f_equal; ring. }
  assert (R4 : vnorm (vsub (rot mid (vscale sg unit3)) (vscale (/l) (v3 w1 w2 w3))) <= 3.53*u).
  { unfold vnorm. apply Rle_trans with (sqrt ((2*eps/(2+eps))*(2*eps/(2+eps)))).
    - apply sqrt_le_1_alt. unfold mid. apply middle; try assumption. apply El. pose proof u_val; lra.
    - change ((2*eps/(2+eps))*(2*eps/(2+eps))) with (Rsqr (2*eps/(2+eps))). rewrite sqrt_Rsqr_abs. unfold Rdiv.
      pose proof u_val. assert (0 < 2 + eps) by lra.
      rewrite Rabs_mult, (Rabs_right (/(2+eps))) by (left; now apply Rinv_0_lt_compat).
      apply Rmult_le_reg_r with (2+eps); [assumption|]. rewrite Rmult_assoc, Rinv_l by lra.
        rewrite Rabs_mult, (Rabs_right 2) by lra. rewrite u_val in *. clear - Heps eb. lra. }
  assert (R5 : vnorm (vsub (vscale d (rot mid (vscale sg unit3))) (vscale (d/l) (v3 w1 w2 w3))) <= 3.53*u*d).
  { replace (vscale (d/l) (v3 w1 w2 w3)) with (vscale d (vscale (/l) (v3 w1 w2 w3))) by (unfold vscale; simpl; f_equal;
    field; lra).
    rewrite <- vscale_sub, vnorm_scale, (Rabs_right d), Rmult_comm by lra. apply Rmult_le_compat_r; [lra|exact R4]. }
  assert (R6 : vnorm (vsub (vscale (d/l) (v3 w1 w2 w3)) (vscale (ds/l) (v3 w1 w2 w3))) <= 2.53*u*S).
  { replace (vsub (vscale (d/l) (v3 w1 w2 w3)) (vscale (ds/l) (v3 w1 w2 w3))) with (vscale ((d-ds)/l) (v3 w1 w2 w3)) by
    (unfold vsub, vscale; simpl; f_equal; field; lra).
    rewrite vnorm_scale. assert (Nw : vnorm (v3 w1 w2 w3) = l) by reflexivity. rewrite Nw. unfold Rdiv.
      rewrite Rabs_mult, (Rabs_right (/l)) by (left; now apply Rinv_0_lt_compat).
    rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. apply d_err. }
  assert (DF : d <= 1.0000001*S /\ F <= 1.0000001*S).
  { pose proof F_err as X. assert (0 < S) by (unfold S; lra). rewrite u_val in X.
    unfold Rabs in X; destruct (Rcase_abs (F - S)); lra. }
  unfold wrist_fk. fold vh.
  eapply Rle_trans. apply (vsub_tri _ (rot g2 vh)).
  eapply Rle_trans. apply Rplus_le_compat_l. apply (vsub_tri _ (rot gl vh)).
  eapply Rle_trans. apply Rplus_le_compat_l, Rplus_le_compat_l. apply (vsub_tri _ (rot mt x)).
  eapply Rle_trans. apply Rplus_le_compat_l, Rplus_le_compat_l, Rplus_le_compat_l.
    apply (vsub_tri _ (vscale d (rot mid (vscale sg unit3)))).
  eapply Rle_trans. apply Rplus_le_compat_l, Rplus_le_compat_l, Rplus_le_compat_l, Rplus_le_compat_l.
    apply (vsub_tri _ (vscale (d/l) (v3 w1 w2 w3))).
  rewrite R1. rewrite R1 in N2. rewrite R3 in R2.
  assert (PS : 0 < S) by (unfold S; lra). fold S.
  assert (M1 : 2*(1.8482*k)*vnorm x <= 2*(1.8482*k)*S) by (apply Rmult_le_compat_l; [apply Rmult_le_pos;
    lra|assumption]).
  assert (M2 : 2*(2.4147*k)*vnorm vh <= 2*(2.4147*k)*S) by (apply Rmult_le_compat_l; [apply Rmult_le_pos;
    lra|assumption]).
  assert (M3 : 2*(1.001*u)*vnorm vh <= 2*(1.001*u)*S) by (apply Rmult_le_compat_l; [apply Rmult_le_pos;
    lra|assumption]).
  assert (Uk : k <= 5.9604649e-8) by (unfold k; rewrite u_val; lra).
  assert (UK : u/(1-u) <= 5.9604649e-8). { apply Rmult_le_reg_r with (1-u). lra. unfold Rdiv.
    rewrite Rmult_assoc, Rinv_l by lra. rewrite u_val. lra. }
  assert (M4 : 9*(u/(1-u))*F <= 9*5.9604649e-8*(1.0000001*S)). { apply Rmult_le_compat; try lra.
    apply Rmult_le_pos; [lra|]. apply Rmult_le_pos; [lra|]. left; apply Rinv_0_lt_compat; lra. }
  assert (M5 : 3.53*u*d <= 3.53*u*(1.0000001*S)) by (apply Rmult_le_compat_l; lra).
  assert (M6 : 2*(1.8482*k)*S <= 2*(1.8482*5.9604649e-8)*S) by (apply Rmult_le_compat_r; lra).
  assert (M7 : 2*(2.4147*k)*S <= 2*(2.4147*5.9604649e-8)*S) by (apply Rmult_le_compat_r; lra).
  rewrite u_val in N3, M3, M5, R5, R6, R2.
  clear - N1 N2 N3 M1 M2 M3 M4 M5 M6 M7 R2 R5 R6 PS.
  rewrite u_val in *. lra.
Qed.
End Arm.
